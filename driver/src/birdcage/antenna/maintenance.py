"""What a dish does that leaves its position in doubt: homing, stowing, motors without current, the end of a search."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from birdcage.antenna.az_el import AzEl
from birdcage.antenna.gate import MotionGate
from birdcage.base.reason import Reason
from birdcage.rotator.facts import SearchSwitch
from birdcage.rotator.feature import END_TV_SEARCH, TV_SEARCH, Reading


class Maintenance:
    """The gate forgets before, so that no target is judged by what was."""

    def __init__(self, rotator: AzEl, gate: MotionGate) -> None:
        self._rotator, self._gate = rotator, gate

    def home(self, motor: int) -> None:
        """Find the reference of an axis. CommandRefused (`unsupported`) where the dish homes only by itself."""
        self._gate.forget(Reason.UNREAD)
        self._rotator.home(motor)
        self._gate.found_reference(motor)

    def stow(self) -> None:
        """Fold the dish flat, as the firmware does it. CommandRefused (`unsupported`) where it does not."""
        self._gate.forget(Reason.UNREAD)
        self._rotator.stow()

    def release_motors(self, *, permit: Callable[[], None] | None = None) -> None:
        """Take the current off the motors. CommandRefused (`unsupported`) where that can't be done.

        The station's own permission is not asked: STOP may do this too. `permit` may raise to keep it back.
        """

        def goes_out() -> None:
            if permit is not None:
                permit()
            self._gate.release()

        self._rotator.release_motors(goes_out)

    def end_search(self) -> Mapping[str, Reading]:
        """End the firmware's TV search, or switch it off: see `Facts.search_switch`. Return what was read back."""
        try:
            if self._rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP:
                return {END_TV_SEARCH: self._rotator.write(END_TV_SEARCH, True)}
            return {TV_SEARCH: self._rotator.write(TV_SEARCH, False)}
        finally:
            if self._rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP:
                self._gate.forget(Reason.UNREAD)
