"""What the pocket view is made of."""
