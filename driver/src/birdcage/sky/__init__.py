"""What is up there. Knows no hardware."""
