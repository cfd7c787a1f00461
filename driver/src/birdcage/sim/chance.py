"""Random figures that repeat: one generator for each purpose, so that a new one does not shift the others."""

from __future__ import annotations

import random


def seeded(purpose: str, seed: int) -> random.Random:
    """Return the generator of one purpose."""
    return random.Random(f"{purpose} {seed}")  # noqa: S311 - noise, not secrets
