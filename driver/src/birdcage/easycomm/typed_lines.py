"""The raw console of an EasyComm rotator: after a line that a person typed, no target counts as ours."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.console.line_session import LineSession
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.line_raw import LineRaw, LineTyped
from birdcage.rotator.raw import CommandDoc, Permit
from birdcage.rotator.verdict import Grade


class EasycommRaw(LineRaw):
    """As that of any machine of plain lines."""

    def __init__(
        self, session: Callable[[], LineSession], hazards: HazardTable, commands: tuple[CommandDoc, ...],
        boot_marks: tuple[str, ...], forget: Callable[[], None],
    ) -> None:  # fmt: skip
        super().__init__(session, hazards, commands, boot_marks)
        self._forget = forget

    def type_line(
        self, line: str, place: str | None, *, takes_s: float, confirmed: Grade, permit: Permit
    ) -> LineTyped:  # fmt: skip
        """Send a line as it was typed."""
        self._forget()
        return super().type_line(line, place, takes_s=takes_s, confirmed=confirmed, permit=permit)
