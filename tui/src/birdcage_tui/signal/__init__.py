"""The signal page's panes, one a file."""
