"""What the setup page is made of: the list of steps, the answers, the causes of silence, the wiring."""
