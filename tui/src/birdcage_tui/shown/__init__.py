"""What one frame shows, as data and as words. Pure: no widget, no file, no thread."""
