"""What is missing before a station can be used, and what mends each: for `birdcage ready` and for the app's F1."""
