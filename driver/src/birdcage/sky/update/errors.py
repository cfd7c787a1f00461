"""What can go wrong between here and a server."""

from __future__ import annotations

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason


class FetchError(BirdcageError):
    """Nothing usable came, and what is known stays as it was.

    Reasons: offline (no server, no name, no route), timeout, tls, redirects, truncated, too_large, garbage,
    http (a status that means no; `status` has it), url.
    """

    reason = Reason.OFFLINE

    def __init__(self, message: str, *, reason: Reason | None = None, status: int | None = None) -> None:
        super().__init__(message, reason=reason)
        self.status = status
