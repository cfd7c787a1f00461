"""What the control page is made of."""
