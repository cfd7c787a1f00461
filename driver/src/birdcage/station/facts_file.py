"""`facts.json` in the folder of a dish: what is known of it itself, for the programs that come after."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from birdcage.antenna.gear import AXES, MOST_DEG, NAMES, PLAY
from birdcage.base.errors import ConfigError
from birdcage.base.paths import write_aside_and_rename
from birdcage.link.identity import dish_folder, dish_identity
from birdcage.rotator.facts import SecondMove
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import SECOND_MOVES, OwnFact, OwnFacts
from birdcage.station.facts_taken_over import earlier_firmware, earlier_told, remove_earlier, told_in

FILE = "facts.json"


@dataclass(frozen=True, slots=True)
class FactsFile:
    """That of one dish that speaks a firmware; None while its firmware is unknown."""

    path: Path
    firmware: str | None

    @classmethod
    def of(cls, state_folder: Path, port: str, firmware: str | None) -> FactsFile | None:
        """Return that of the dish at a port, of the firmware that is kept there where none is named.

        None if the port has no identity.
        """
        identity = dish_identity(port)
        if identity is None:
            return None
        path = dish_folder(state_folder, identity) / FILE
        kept = told_in(path).get("firmware") or earlier_firmware(path.parent)
        return cls(path, firmware or (kept if isinstance(kept, str) else None))

    def read(self) -> OwnFacts:
        """Return what is known; nothing where that cannot be read or believed, or is of another firmware."""
        if self.path.exists():
            told = told_in(self.path)
            return _facts_in(told.get("facts") if told.get("firmware") == self.firmware else ())
        own = OwnFacts()
        for told_then in earlier_told(self.path.parent, self.firmware):
            for name, fact in _facts_in(told_then).facts.items():
                own = own.with_fact(name, fact)
        if own.facts:
            with suppress(OSError):  # then the next program takes it over
                self.write(own)
                remove_earlier(self.path.parent)
        return own

    def write(self, own: OwnFacts) -> None:
        """Keep it for the programs that come after. OSError."""
        facts = [
            {
                "name": name, "value": round(fact.value, 4) if isinstance(fact.value, float) else fact.value,
                "origin": fact.origin.value, "utc": fact.utc.isoformat(timespec="seconds"), "readings": fact.readings,
            }
            for name, fact in own.facts.items()
        ]  # fmt: skip
        write_aside_and_rename(self.path, json.dumps({"firmware": self.firmware, "facts": facts}).encode())

    def set_play(self, az_deg: float | None, el_deg: float | None, utc: datetime) -> None:
        """Keep the play that the owner has measured; None leaves that of an axis.

        ConfigError for what is no play, or where it can't be kept; what was known then stays as it was.
        """
        own = self.read()
        for axis, deg in zip(AXES, (az_deg, el_deg), strict=True):
            if deg is not None:
                name = f"{axis}.{PLAY}"
                own = own.with_fact(name, OwnFact(checked(name, deg), Origin.USER, utc))
        with self._or_complain():
            self.write(own)

    def forget_gear(self) -> None:
        """Know nothing of the dish's play and overshoot any more. ConfigError where it can't be written."""
        self._forget(lambda name: name in NAMES)

    def forget(self) -> None:
        """Know nothing of the dish any more. ConfigError where it can't be written."""
        self._forget(lambda _name: True)

    def _forget(self, is_meant: Callable[[str], bool]) -> None:
        own = self.read()
        for name in own.facts:
            own = own.with_fact(name, None) if is_meant(name) else own
        with self._or_complain():
            if own.facts:
                self.write(own)
            else:
                remove_earlier(self.path.parent)
                self.path.unlink(missing_ok=True)

    @contextmanager
    def _or_complain(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise ConfigError(f"{self.path} can't be written ({error.strerror or error}): nothing was kept.") from error


def _facts_in(told: Any) -> OwnFacts:  # noqa: ANN401 - whatever JSON has there
    own = OwnFacts()
    try:
        for each in told:
            name, origin = each["name"], Origin(each["origin"])
            value, readings = checked(name, each["value"]), int(each["readings"])
            utc = datetime.fromisoformat(each["utc"])
            if utc.tzinfo is None or readings < 0 or origin not in (Origin.LEARNT, Origin.USER):
                return OwnFacts()
            own = own.with_fact(name, OwnFact(value, origin, utc, readings))
    except (ValueError, KeyError, TypeError, OverflowError, AttributeError, ConfigError):
        return OwnFacts()
    return own


def checked(name: str, value: float | str) -> float | str:
    """Return a value that can be one. ConfigError for an angle that cannot, KeyError or ValueError for no fact."""
    if name in SECOND_MOVES:
        return SecondMove(value).value
    kind, deg = NAMES[name], float(value)
    least = 0.0 if kind == PLAY else -MOST_DEG[kind]
    if not least <= deg <= MOST_DEG[kind]:
        raise ConfigError(f"A play of {deg:g}° can't be right: type 0 to {MOST_DEG[kind]:g}.")
    return deg
