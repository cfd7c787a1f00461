"""The class that dialects derive from, and the machine that the seam makes of one: what a dialect imports."""

from __future__ import annotations

from birdcage.protocol.firmware import FirmwareProtocol
from birdcage.rotator.adapting import as_rotator
from birdcage.rotator.rotator import Rotator

__all__ = ["FirmwareProtocol"]


@as_rotator.register
def _(machine: FirmwareProtocol) -> Rotator:
    from birdcage.protocol.documented import DocumentedRotator, keeps_to_the_document
    from birdcage.protocol.menu_rotator import MenuRotator

    return DocumentedRotator(machine) if keeps_to_the_document(machine) else MenuRotator(machine)
