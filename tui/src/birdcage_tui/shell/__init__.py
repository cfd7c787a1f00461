"""The app itself: one screen, pages behind keys, commands, and the way from the station's events to a frame."""
