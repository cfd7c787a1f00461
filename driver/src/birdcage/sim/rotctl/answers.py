"""What a simulated rotctld does and answers, command by command (`docs/reference/rotctl.md`)."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from birdcage.sim.machine import Machine
from birdcage.sim.rotctl.knobs import RotctlSettings
from birdcage.sim.rotctl.mechanics import RotatorMechanics

TAKES = {
    "p": 0, "P": 2, "S": 0, "K": 0, "R": 1, "M": 2, "_": 0, "s": 0, "v": 1, "V": 2, "w": -1, "1": 0, "q": 0, "Q": 0,
    "dump_state": 0,
}  # fmt: skip
"""How many arguments each command takes; -1: the rest of its line."""
LONG = {
    "get_pos": "p", "set_pos": "P", "stop": "S", "park": "K", "reset": "R", "move": "M", "get_info": "_",
    "get_status": "s", "get_level": "v", "set_level": "V", "send_cmd": "w", "dump_caps": "1",
    "dump_state": "dump_state",
}  # fmt: skip
NAMES = {letter: name for name, letter in LONG.items()}
DIRECTIONS = {
    "2": (1, 1), "4": (1, -1), "8": (0, -1), "16": (0, 1), "UP": (1, 1), "DOWN": (1, -1), "LEFT": (0, -1),
    "CCW": (0, -1), "RIGHT": (0, 1), "CW": (0, 1),
}  # fmt: skip
"""Of `M`: the axis, and which way it turns."""
END_NAMES = "Minimum Azimuth", "Maximum Azimuth", "Minimum Elevation", "Maximum Elevation"
EINVAL, ENIMPL, EIO = -1, -4, -6
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(nan|inf)")


@dataclass(frozen=True, slots=True)
class TypedCommand:
    """One command as it was read."""

    letter: str
    arguments: tuple[str, ...]
    extended: str
    """The character before it that asks for the extended reply; empty for the default one."""

    @property
    def text(self) -> str:
        """As one would type it."""
        name = self.letter if len(self.letter) == 1 else f"\\{self.letter}"
        return self.extended + " ".join((name, *self.arguments))


@dataclass(frozen=True, slots=True)
class Answer:
    """Values by the names that the extended reply gives them, and a code."""

    values: tuple[tuple[str, str], ...] = ()
    """A name may be empty."""
    code: int = 0
    ends_in_code: bool = False
    """Whether its code is told though it has values."""
    extended: tuple[tuple[str, str], ...] = ()
    """The values of the extended reply, where that has others."""


def scanned(text: str) -> float | None:
    """Read a number as scanf does: what follows it is left, so `10,5` is 10."""
    found = _NUMBER.match(text)
    return None if found is None else float(found[0])


class Answerer:
    """The server's table of commands."""

    def __init__(self, machine: Machine, settings: RotctlSettings, dish: RotatorMechanics) -> None:
        self._machine, self._settings, self._dish = machine, settings, dish
        self._table: dict[str, Callable[..., Answer | None]] = {
            "p": self._get_position, "P": self._set_position, "S": self._stop, "K": self._park, "R": self._reset,
            "M": self._move, "_": self._info, "s": self._status, "v": self._get_level, "V": self._set_level,
            "w": self._send_command, "1": self._caps, "dump_state": self._state, "q": self._quit, "Q": self._quit,
        }  # fmt: skip

    @property
    def _now_s(self) -> float:
        return self._machine.dish_s

    def answer(self, command: TypedCommand) -> str:
        """Carry a command out, and return all that is written; empty where that is nothing."""
        done = self._table[command.letter](*command.arguments)
        if done is None:
            return ""
        space = " " if self._settings.code_space and done.code == 0 else ""
        code = f"RPRT {done.code}{space}"
        if not command.extended:
            lines = [value for _, value in done.values] if done.code == 0 else []
            if not done.values or done.code or done.ends_in_code:
                lines.append(code)
            return "".join(f"{line}\n" for line in lines)
        parted = "\n" if command.extended == "+" else command.extended
        typed = "".join(f" {argument}" for argument in command.arguments)
        values = [f"{name}: {value}" if name else value for name, value in done.extended or done.values]
        return parted.join([f"{NAMES[command.letter]}:{typed}", *values, code]) + "\n"

    def _angles(self) -> tuple[float, float]:
        az, el = self._dish.axes
        return az.count(self._now_s)[0], el.count(self._now_s)[0]

    def _get_position(self) -> Answer:
        if self._settings.lost:
            return Answer(code=EIO)
        az, el = (f"{deg:.{self._settings.decimals}f}" for deg in self._angles())
        return Answer((("Azimuth", az), ("Elevation", el)))

    def _set_position(self, az_text: str, el_text: str) -> Answer:
        settings, to = self._settings, (scanned(az_text), scanned(el_text))
        if settings.lost:
            return Answer(code=EIO)
        ends = (settings.min_az, settings.max_az), (settings.min_el, settings.max_el)
        for deg, (low, high) in zip(to, ends, strict=True):
            if deg is None:
                return Answer(code=EINVAL)
            if deg < low or deg > high:
                return Answer(code=settings.range_code)
        for index, deg in enumerate(to):
            if deg is not None and math.isfinite(deg):  # `nan` passes the check of the range, and moves nothing
                self._dish.go(self._now_s, index, deg)
        return Answer()

    def _stop(self) -> Answer | None:
        how = self._settings.stop
        if how in ("reply", "mute"):
            self._dish.brake(self._now_s)
        if how == "error":
            return Answer(code=ENIMPL)
        return Answer() if how == "reply" else None

    def _park(self) -> Answer:
        for index, deg in enumerate((self._settings.park_az, self._settings.park_el)):
            self._dish.go(self._now_s, index, deg)
        return Answer()

    def _reset(self, what: str) -> Answer:
        return Answer() if scanned(what) is not None else Answer(code=EINVAL)

    def _move(self, direction: str, speed: str) -> Answer:
        turn, level = DIRECTIONS.get(direction), scanned(speed)
        if turn is None or level is None or not (level == -1 or 1 <= level <= 100):
            return Answer(code=EINVAL)
        index, sign = turn
        data = self._dish.axes[index].data
        end_deg = data.high_deg if sign > 0 else data.low_deg
        self._dish.go(self._now_s, index, end_deg, None if level == -1 else int(level))
        return Answer()

    def _info(self) -> Answer:
        return Answer((("Info", self._settings.info),))

    def _status(self) -> Answer:
        flags = ["MOVING"] if self._dish.moving(self._now_s) else []
        for axis, name, down, up in zip(self._dish.axes, ("AZ", "EL"), ("LEFT", "DOWN"), ("RIGHT", "UP"), strict=True):
            if axis.moving(self._now_s):
                flags += [f"MOVING_{name}", f"MOVING_{up if axis.count(self._now_s)[1] > 0 else down}"]
        told = "".join(f"{flag} " for flag in flags * (2 if self._settings.flags_twice else 1))
        return Answer((("Status flags", told),))

    def _get_level(self, level: str) -> Answer:
        if level == "?":
            return Answer((("", "SPEED"),))
        return Answer((("", str(self._dish.level)),)) if level == "SPEED" else Answer(code=EINVAL)

    def _set_level(self, level: str, text: str) -> Answer:
        value = scanned(text)
        if level != "SPEED" or value is None or not 1 <= value <= 100:
            return Answer(code=EINVAL)
        self._dish.level = int(value)
        return Answer()

    def _send_command(self, _line: str) -> Answer:
        return Answer(code=EIO)

    def _caps(self) -> Answer:
        settings = self._settings
        told = (
            f"Caps dump for model:\t{settings.model}", f"Model name:\t{settings.info}",
            f"Rot type:\t{settings.rot_type}",
            f"Min Azimuth:\t{settings.min_az:.2f}", f"Max Azimuth:\t{settings.max_az:.2f}",
            f"Min Elevation:\t{settings.min_el:.2f}", f"Max Elevation:\t{settings.max_el:.2f}",
        )  # fmt: skip
        return Answer(tuple(("", line) for line in told), ends_in_code=True)

    def _state(self) -> Answer | None:
        settings, how = self._settings, self._settings.dump_state
        if how == "silent":
            return None
        if how == "error":
            return Answer(code=ENIMPL)
        ends = {
            "min_az": settings.min_az,
            "max_az": settings.max_az,
            "min_el": settings.min_el,
            "max_el": settings.max_el,
        }
        if how == "bare":
            lines = ["0", str(settings.model), *(f"{deg:f}" for deg in ends.values())]
        else:
            tags = [f"{tag}={deg:f}" for tag, deg in ends.items()]
            lines = ["1", str(settings.model), *tags, "south_zero=0", f"rot_type={settings.rot_type}", "done"]
        extended = (
            ("rotctld Protocol Ver", lines[0]), ("Rotor Model", lines[1]),
            *((name, f"{deg:f}") for name, deg in zip(END_NAMES, ends.values(), strict=True)),
            ("South Zero", "0"), ("", f"rot_type={settings.rot_type}"), ("", "done"),
        )  # fmt: skip
        return Answer(tuple(("", line) for line in lines), extended=extended)

    def _quit(self) -> None:
        """Say nothing. A real server hangs up, which the wire of a simulated dish cannot."""
