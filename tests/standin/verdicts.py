"""Holds what a command said against what the stand-in dish did: every complaint is a sentence."""

from __future__ import annotations

import json
import re

from .typed import Said, Terminal

FLOOR_DEG, CEILING_DEG = 18.0, 65.0
NEAR_DEG = 0.08
WIRE_S = 0.3
"""How long what a command has sent at its end may be under way."""
STANDS = re.compile(r"[Ss]tands still at (-?[\d.]+)°/(-?[\d.]+)°")
SHOWN = re.compile(r"\r\x1b\[K[^\r\n]*(?=\r\x1b\[K)|\r\x1b\[K")
NOT_STOPPED = re.compile(r"not answered|goes on|may still|not known|not confirmed|look at it|cut (its|the) power|12 V")
DEADLOCKED = re.compile("deadlocked")
ONLY_DEADLOCKED = re.compile(r"(?<!; a )(?<!or the dish's shell is )deadlocked")
"""Among other causes of a silence it may be named, as they look the same."""
MOVERS = {"move", "home", "track", "autotrack", "calibrate", "setup"}


class Verdict:
    """What a dish does in the course of one command, judged."""

    def __init__(self, terminal: Terminal, *, strict: bool = True) -> None:
        self._terminal, self._dish = terminal, terminal.dish
        self._strict = strict
        """Whether the dish is in good order, so that no cause of a silence is true of it."""
        self._since = terminal.clock.monotonic()
        self._moved_before = self._dish.moves()
        self._before = self._dish.where()

    def of(self, said: Said) -> list[str]:
        """Return all that is wrong with what a command did and said."""
        dish = self._dish
        text = SHOWN.sub("", said.text)
        wrong = [f"crash: {said.crash!r}"] if said.crash is not None else []
        if "Traceback" in text or said.code == 70:
            wrong.append("a traceback")
        if dish.root_q:
            wrong.append(f"{dish.root_q} q at root")
        if dish.alive and (DEADLOCKED if self._strict else ONLY_DEADLOCKED).search(text):
            wrong.append("a healthy dish is called deadlocked")
        wrong += self._motion(said)
        wrong += self._claims(said, text)
        return wrong

    def afterwards(self, said: Said) -> list[str]:
        """Return what became untrue once all that was under way has ended."""
        text = SHOWN.sub("", said.text)
        told = STANDS.findall(text)
        wrong = self._far("said that it stands still", told[-1], self._near) if told else []
        if said.words[0] == "move" and said.code == 0 and "--no-wait" not in said.words:
            wrong += self._far("`move` was content", (said.words[2], said.words[4]), self._near)
        return wrong

    @property
    def _near(self) -> float:
        habits = self._dish.habits
        return NEAR_DEG + 0.6 * 10**-habits.decimals + habits.overshoot_deg

    def _motion(self, said: Said) -> list[str]:
        dish, wrong = self._dish, []
        asked = dish.asked(self._since)
        for each in asked:
            low, high = (-423.33, 360.0) if each.axis == 0 else (FLOOR_DEG, CEILING_DEG)
            if not low <= each.deg <= high:
                wrong.append(f"axis {each.axis} was sent to {each.deg}, beyond its limits")
        low, high = dish.span(1)
        if low < FLOOR_DEG - 0.1 or high > CEILING_DEG + 0.1:
            wrong.append(f"the elevation went from {low:.2f} to {high:.2f}")
        own = [each for each in asked if each.at > self._since + WIRE_S]
        if said.words[0] not in MOVERS and not self._moved_before:
            wrong += [
                f"`{said.words[0]}` sent axis {each.axis} of a dish at rest from {here:.1f} to {each.deg:.1f}"
                for each in own
                if _off(each.deg, here := self._before[each.axis]) > 1.0 and each.taken
            ]
        return wrong

    def _claims(self, said: Said, text: str) -> list[str]:
        dish, wrong, code = self._dish, [], said.code
        near = self._near
        told = STANDS.findall(text)
        if told:
            if dish.moves():
                wrong.append(f"told to stand still at {told[-1]}, and it moves")
            wrong += self._far("told to stand still", told[-1], near)
        if code == 130 and said.words[0] == "move" and dish.moves() and not NOT_STOPPED.search(text):
            wrong.append("it moves on after Ctrl+C, and nothing is said of it")
        if said.words[0] == "stop" and code == 0 and dish.moves():
            wrong.append("`stop` is content, and the dish moves")
        if said.words[0] == "move" and code == 0 and "--no-wait" not in said.words:
            if dish.moves() and dish.habits.decimals > 1:  # else its numbers can't tell
                wrong.append("`move` is content, and the dish moves")
            wrong += self._far("`move` is content", (said.words[2], said.words[4]), near)
        if said.words[0] == "home" and code == 0 and not all(dish.mechanics.homed):
            wrong.append("`home` is content, and the dish is not homed")
        if said.words[:2] == ("pos", "--json") and code == 0:
            place = json.loads(said.out)
            rested = _off(self._before[0], dish.where()[0]) < near and abs(self._before[1] - dish.where()[1]) < near
            wrong += (
                [] if not rested else self._far("`pos` tells", (place["azimuth_deg"], place["elevation_deg"]), near)
            )
            if not all(dish.mechanics.homed):
                wrong.append("`pos` tells a place, and the dish is not homed")
        return wrong

    def _far(self, what: str, place, near: float) -> list[str]:
        here = self._dish.where()
        off = max(_off(float(place[0]), here[0]), abs(float(place[1]) - here[1]))
        return [f"{what} at {place}, and it is at {here[0]:.2f}/{here[1]:.2f}"] if off > near else []


def _off(one: float, other: float) -> float:
    return abs((one - other + 180.0) % 360.0 - 180.0)
