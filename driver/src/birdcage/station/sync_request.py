"""The request that syncs a machine: where it points."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sync:
    """Sync a machine whose zero is where it was switched on: say where it points now, in true degrees. Nothing turns.

    Its future resolves with the `Pointing` that is read then. CommandRefused (`unsupported`) of a machine that knows
    by itself (`Facts.no_sync`), BirdcageError (`moving`) in motion. HELD does not keep it back, and stays.
    """

    az_deg: float
    el_deg: float | None
    """None: its elevation stays as it tells it. An elevation that it measures itself stays in any case."""
    holder: str
    agreed: bool = False
    """Whether a person was told what the machine itself says, and agreed. Else ConfirmationNeeded where it differs."""
