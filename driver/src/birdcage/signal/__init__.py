"""What is heard, and by what: sources of a signal level, and which of them is read at a moment."""
