"""Which birdcage this is."""

from __future__ import annotations


def version() -> str:
    """Return the version of the installed driver."""
    from importlib.metadata import version as installed

    return installed("winegard-birdcage")
