"""What happens to the bytes of one direction, spell by spell, and which of them were altered."""

from __future__ import annotations

import random

from birdcage.sim.wire import PASS, Byte

NUMERALS = frozenset(b"0123456789.+-")
FORGES_NOTHING = bytes(value for value in range(256) if value > 0x7F or not (chr(value).isalpha() or value in b"+-"))
"""What noise is made of: a letter could make one command of another, `r` of `a`, and a sign a step of an angle."""
LAG_S = 2.0
"""The longest delay: D of `docs/decisions/0003-q-in-step.md`."""
SPELLS = {"clear": 50, "split": 10, "late": 8, "drizzle": 16, "storm": 10, "silent": 6}
"""How likely each kind of weather is."""


class FaultMix:
    """A plan for a lane of the simulator's wire."""

    def __init__(self, rng: random.Random) -> None:
        self._rng = rng
        self.spell = "clear"
        self._lag_s = 0.0
        self.altered = False
        """Whether a byte was lost, doubled or replaced since `begin`."""
        self.numeral = False
        """Whether one of them was, or became, a part of a number."""

    def change(self) -> None:
        """Begin another spell."""
        self.spell = self._rng.choices(list(SPELLS), SPELLS.values())[0]
        self._lag_s = self._rng.uniform(0.1, LAG_S)

    def clear(self) -> None:
        """Let everything pass."""
        self.spell = "clear"

    def begin(self) -> None:
        """Note from now on what is altered."""
        self.altered = self.numeral = False

    def __call__(self, value: int) -> Byte:
        """Decide what happens to one byte."""
        rng = self._rng
        match self.spell:
            case "split":
                return Byte(delay_s=rng.choice((0.0, 0.0, 0.001, 0.03, 0.2)))
            case "late":
                return Byte(delay_s=rng.uniform(0.0, self._lag_s))
            case "silent":
                return self._alter(value, Byte(drop=True))
            case "drizzle" | "storm":
                if rng.random() < (0.004 if self.spell == "drizzle" else 0.05):
                    return self._alter(value, self._fault())
        return PASS

    def _fault(self) -> Byte:
        rng = self._rng
        noise = bytes(rng.choices(FORGES_NOTHING, k=rng.choice((1, 1, 2))))
        return rng.choice((Byte(drop=True), Byte(double=True), Byte(noise=noise), Byte(drop=True, noise=noise[:1])))

    def _alter(self, value: int, action: Byte) -> Byte:
        self.altered = True
        touched = {*action.noise, *((value,) if action.drop or action.double else ())}
        self.numeral = self.numeral or bool(touched & NUMERALS)
        return action
