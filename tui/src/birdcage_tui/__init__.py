"""The terminal app of birdcage: faces on the station, nothing below it."""
