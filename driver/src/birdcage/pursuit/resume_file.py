"""What was being followed, on disk: so that a program which died in mid-pass can say so when it starts again."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, fields
from datetime import datetime
from pathlib import Path
from typing import TypeVar

from birdcage.base.paths import write_aside_and_rename
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file

FILE = "pursuit.json"
_T = TypeVar("_T")


@dataclass(frozen=True, slots=True)
class KeptPursuit:
    """One pursuit in mid-pass."""

    text: str
    """What `choose` was given."""
    name: str
    since: datetime
    reach_end: datetime | None
    """None for what is always up in reach."""
    seen: datetime
    """When this was written: the program was alive then."""
    az_deg: float
    """True: where the dish was last sent."""
    el_deg: float
    ahead_az_deg: float
    """Where it was to be a moment later: it may have come that far before the program died."""
    ahead_el_deg: float
    aos: datetime | None = None
    """Of the pass; None for what does not pass."""
    frequency_hz: float | None = None
    """As the person had set it; None for the usual one."""
    time_offset_s: float = 0.0
    left: bool = False
    """Whether the program was ended in order meanwhile: a person did that, and the dish was stopped."""


class ResumeFile:
    """`pursuit.json` in the dish's own folder. OSError never leaves it: a full disk shall not end a pursuit."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        self.problem = ""
        """Why the last one could not be written."""

    def write(self, kept: KeptPursuit) -> None:
        """Write what is being followed."""
        values = {key: each.isoformat() if isinstance(each, datetime) else each for key, each in asdict(kept).items()}
        try:
            write_aside_and_rename(self._path, json.dumps(values, indent=1).encode())
        except OSError as error:
            self.problem = f"{self._path} cannot be written ({error.strerror or error}): a restart would not know."
        else:
            self.problem = ""

    def clear(self) -> None:
        """Forget it: the pursuit ended in order."""
        try:
            self._path.unlink(missing_ok=True)
        except OSError as error:
            self.problem = f"{self._path} cannot be removed ({error.strerror or error})."

    def read(self) -> KeptPursuit | None:
        """Return what was being followed; None for nothing, and for a file of another origin."""
        try:
            values = clean_all(json.loads(read_user_file(self._path)))
        except (OSError, ValueError):
            return None
        try:
            return _kept(values)
        except (KeyError, TypeError, ValueError):
            return None


def _kept(values: dict[str, object]) -> KeptPursuit:
    """Return it with the types that it was written with. KeyError, TypeError or ValueError for anything else."""

    def moment(key: str) -> datetime:
        when = datetime.fromisoformat(_of(str, values[key]))
        if when.tzinfo is None:
            raise ValueError(key)
        return when

    unknown = set(values) - {each.name for each in fields(KeptPursuit)}
    if unknown:
        raise ValueError(f"unknown: {sorted(unknown)}")
    frequency = values["frequency_hz"]
    return KeptPursuit(
        text=_of(str, values["text"]), name=_of(str, values["name"]), since=moment("since"),
        reach_end=None if values["reach_end"] is None else moment("reach_end"),
        seen=moment("seen"), az_deg=_number(values["az_deg"]),
        el_deg=_number(values["el_deg"]),
        ahead_az_deg=_number(values["ahead_az_deg"]), ahead_el_deg=_number(values["ahead_el_deg"]),
        aos=None if values["aos"] is None else moment("aos"),
        frequency_hz=None if frequency is None else _number(frequency),
        time_offset_s=_number(values["time_offset_s"]), left=_of(bool, values["left"]),
    )  # fmt: skip


def _number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise TypeError(f"{value!r} is no number")
    return float(value)


def _of(kind: type[_T], value: object) -> _T:
    if not isinstance(value, kind):
        raise TypeError(f"{value!r} is no {kind.__name__}")
    return value
