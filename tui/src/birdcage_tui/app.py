"""The published name of the entry point: `birdcage_tui.app:main`. The app itself is `shell.birdcage_app`."""

from birdcage_tui.main import main

__all__ = ["main"]
