"""Step 7: which way the axes turn."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.errors import BirdcageError, MotionRefused
from birdcage.base.reason import Reason
from birdcage.setup.step import Choice
from birdcage.setup.steps.base import Plan, Step
from birdcage.station.requests import Goto

STEP_DEG = 5.0
_WRONG = {
    "az": "The azimuth went the other way: this dish counts it counterclockwise, or its azimuth motor is wired in "
    "reverse. Check that you looked from above. Do not point with it until that is fixed.",
    "el": "The elevation went the other way: its motor is wired in reverse, or you looked at the wrong edge of the "
    "dish. Do not point with it until that is fixed.",
}


class DirectionStep(Step):
    """Moves each axis a little, asks what was seen, and moves back."""

    name = "direction"
    title = "Direction"
    page = "control"

    asked = ""
    """`az` or `el` while an answer is waited for."""
    _sign = 1.0
    _start = (0.0, 0.0)
    """Where it stood when it began, within the limits: azimuth and elevation."""
    _seen = ""

    def words(self) -> tuple[str, ...]:
        """Say what will move, or what to look at."""
        if self.asked == "az":
            way = "clockwise" if self._sign > 0 else "counterclockwise"
            return (f"It turned {STEP_DEG:g}° in azimuth. Seen from above, did it turn {way}?",)
        if self.asked == "el":
            way = "higher" if self._sign > 0 else "lower"
            return (f"It moved {STEP_DEG:g}° in elevation. Does it look {way} than before?",)
        return (
            f"Turns {STEP_DEG:g}° in azimuth, then {STEP_DEG:g}° in elevation, and asks each time which way it went.",
            "Then it goes back. Stand where you can see it, out of its swing.",
            *self.trouble(),
            *(
                (f"{self.bench.step_4.capitalize()} it first: step 4.",)
                if self.bench.is_up and self.bench.position is None
                else ()
            ),
        )

    def choices(self) -> tuple[Choice, ...]:
        """Start, or answer."""
        if self.asked:
            return (
                *self.release_choice(),
                Choice("yes", "y", "Yes: now the elevation" if self.asked == "az" else "Yes: go back", moves=True),
                Choice("no", "n", "No: go back", moves=True),
                Choice("again", "a", "Not seen: once more", moves=True),
            )
        if self.bench.position is None:
            return self.release_choice()
        return (*self.release_choice(), Choice("start", "enter", f"Turn it {STEP_DEG:g}°", moves=True))

    def take(self, choice: str, values: Mapping[str, str]) -> None:  # noqa: ARG002 - a step's signature
        """Move, or judge."""
        if choice == "release":
            self.begin(self.release(), "releasing")
        elif choice == "again":
            self.begin(self._again(self.asked), "moving back, then once more")
        elif choice == "start":
            self._seen = ""
            self.begin(self._first(), "turning")
        elif choice == "no":
            self.bench.forget(self.name)  # whatever was kept before is not so
            self.begin(self._back(self.asked), "moving back")
        elif self.asked == "az":
            self._seen = (
                f"az {self._sign * STEP_DEG:+g} deg turned {'clockwise' if self._sign > 0 else 'counterclockwise'}"
            )
            self.begin(self._try("el"), "moving")
        else:
            self._seen += f", el {self._sign * STEP_DEG:+g} deg looked {'up' if self._sign > 0 else 'down'}"
            self.begin(self._back(""), "moving back")

    def _first(self) -> Plan:
        """Go to an elevation that is allowed, where homing has left it above the ceiling; then turn."""
        position, state = self.bench.position, self.bench.state
        assert position is not None, "the choice is only there with a position"
        low = position.el_deg if state.el_min_deg is None else state.el_min_deg
        high = position.el_deg if state.el_max_deg is None else state.el_max_deg
        self._start = position.az_deg, min(max(position.el_deg, low), high)
        if self._start[1] != position.el_deg:
            yield self.bench.ask(Goto(*self._start, self.bench.holder))
        yield from self._try("az")

    def _again(self, axis: str) -> Plan:
        yield self.bench.ask(Goto(*self._start, self.bench.holder))
        yield from self._try(axis)

    def _try(self, axis: str) -> Plan:
        az_start, el_start = self._start
        self.asked = ""
        refusal: BirdcageError | None = None
        for sign in (1.0, -1.0):
            az_deg = (az_start + sign * STEP_DEG) % 360.0 if axis == "az" else az_start
            el_deg = el_start + sign * STEP_DEG if axis == "el" else el_start
            try:
                yield self.bench.ask(Goto(az_deg, el_deg, self.bench.holder))
            except MotionRefused as refused:
                # It may stand at a limit, as after homing: the other way tells as much.
                refusal = refusal or refused
                continue
            self._sign, self.asked = sign, axis
            return
        assert refusal is not None, "both ways were refused"
        raise refusal

    def _back(self, wrong: str) -> Plan:
        self.asked = ""
        yield self.bench.ask(Goto(*self._start, self.bench.holder))
        if wrong:
            raise BirdcageError(f"{_WRONG[wrong]} {self._remedy(wrong)}".rstrip(), reason=Reason.DIRECTION)
        self.bench.done(self.name, f"{self._seen}: seen by you")

    def _remedy(self, wrong: str) -> str:
        """Return what turns an axis of this machine round; empty where its facts name nothing."""
        dish = self.bench.state.dish
        if dish is None:
            return ""
        axis = dish.azimuth if wrong == "az" else dish.elevation
        return dish.handling.reversed_remedies.get(axis.name, "")
