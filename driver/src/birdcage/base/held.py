"""HELD on disk: a dish that was stopped stays stopped for every program, until a person releases it."""

from __future__ import annotations

import contextlib
import getpass
import json
import stat
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import StrEnum
from pathlib import Path

from birdcage.base.paths import write_aside_and_rename

FILE = "held.json"
LONGEST = 4096
"""Bytes that are read of a file: ours has a few hundred."""
CLOCK_STEP = "suspend or clock step"
"""How the words begin of a dish that is held for a step of the clock."""
LONGEST_PORT = 1024
"""Characters of a port's name that are shown: a cut one names no port."""


class HeldReason(StrEnum):
    """Why a dish is HELD."""

    STOP = "stop"
    """Somebody called STOP."""
    LINK = "link"
    """The link was lost while it moved, or somebody had control."""
    CLOCK = "clock"
    """The clock stepped, or the computer slept."""
    FAULT = "fault"
    """Something is wrong with the dish."""
    OTHER = "other"
    """Another version of birdcage holds it, in words of its own."""


@dataclass(frozen=True, slots=True)
class HeldNote:
    """Who holds a dish, since when and why."""

    by: str
    """Who called STOP; empty if the file does not tell."""
    utc: datetime | None
    reason: HeldReason = HeldReason.STOP
    port: str = ""
    """What the port was called then."""
    damage: str = ""
    """Why the rest is not known, as a sentence; empty normally."""
    detail: str = ""
    """More about the reason, in words; empty for nothing."""

    @property
    def why(self) -> str:
        """The reason in words."""
        return self.detail or self.reason.value

    @property
    def sentence(self) -> str:
        """Who holds it, since when and why."""
        if self.damage:
            return f"HELD, by whom is not known: {self.damage}"
        since = "" if self.utc is None else f" since {self.utc:%Y-%m-%d %H:%M:%S}Z"
        why = "" if self.reason is HeldReason.STOP else f" ({self.why})"
        return f"HELD by {self.by}{why}{since}."


class HeldFile:
    """`held.json` in the folder of one dish. Whatever stands in it: while it is there, the dish is HELD."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE

    def read(self) -> HeldNote | None:
        """Return who holds the dish; None if it is free. A file that cannot be read counts as HELD."""
        utc = None
        try:
            status = self.path.stat()
            utc = datetime.fromtimestamp(status.st_mtime, UTC)
            if not stat.S_ISREG(status.st_mode):
                raise ValueError("no file")
            with self.path.open("rb") as file:
                told = json.loads(file.read(LONGEST))
            utc = datetime.fromisoformat(told["utc"]).astimezone(UTC)
            by = _who(_plain(told["by"]), _plain(told["user"]))
            reason, detail = _reason(_plain(told["reason"]))
            return HeldNote(by, utc, reason, _plain(told["port"], LONGEST_PORT), detail=detail)
        except (FileNotFoundError, NotADirectoryError):
            return None
        except OSError as error:
            return HeldNote("", utc, damage=f"{self.path} cannot be read ({error.strerror or error}).")
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return HeldNote("", utc, damage=f"{self.path} is damaged.")

    def write(self, note: HeldNote) -> None:
        """Latch. OSError where not even an empty file can be made; an empty one holds the dish as well."""
        utc = datetime.now(UTC) if note.utc is None else note.utc
        told = {"by": note.by, "user": user_name(), "utc": utc.isoformat(), "reason": note.why, "port": note.port}
        try:
            write_aside_and_rename(self.path, json.dumps(told).encode())
        except OSError:
            # A full disk often still has room for a name.
            if not self.path.parent.is_dir():
                raise
            self.path.touch()

    def remove(self) -> None:
        """Release. OSError where the file cannot be removed: the next program finds the dish HELD."""
        with contextlib.suppress(FileNotFoundError, NotADirectoryError):
            self.path.unlink()


def _plain(text: object, longest: int = 80) -> str:
    if not isinstance(text, str):
        raise TypeError("no text")
    return "".join(letter for letter in text if letter.isprintable())[:longest]


def _reason(words: str) -> tuple[HeldReason, str]:
    """Return the reason that a file tells, and its words where they are no reason by themselves."""
    if words in set(HeldReason):
        return HeldReason(words), ""
    # Of a step the file holds how far: a person should see that again after a restart.
    return (HeldReason.CLOCK if words.startswith(CLOCK_STEP) else HeldReason.OTHER), words


def _who(by: str, user: str) -> str:
    """Return who it was, for whoever reads it later: *you* has a name, and so has whoever pressed Ctrl+C."""
    if by == "you":
        return user
    return by if by == "birdcage" or user in by else f"{user} ({by})"


def user_name() -> str:
    """Return who this program belongs to."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # a container in which this user has no name
        return "somebody"
