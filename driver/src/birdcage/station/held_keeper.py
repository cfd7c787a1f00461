"""Keeps HELD on disk under the identity of the dish, on a thread of its own: STOP never waits for a disk."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from birdcage.base.background import BackgroundWriter
from birdcage.base.held import HeldFile, HeldNote
from birdcage.link.identity import dish_folder, dish_identity, forget_reused


@dataclass(frozen=True, slots=True)
class _Wish:
    """What is to be on disk, in each of these files: a note, or none."""

    files: tuple[HeldFile, ...]
    note: HeldNote | None


class HeldKeeper:
    """Latches and releases return at once; `meet` reads, on the station's thread."""

    def __init__(self, state_folder: Path, identify: Callable[[str], str | None] = dish_identity) -> None:
        """Keep the latches of all dishes in `state_folder`; nothing is written before one is held."""
        self._state, self._identify = state_folder, identify
        self.on_trouble: Callable[[str], None] = lambda _sentence: None
        """Told after each change, on the writer's thread: why it is not on disk; empty when it is."""
        self._file: HeldFile | None = None
        self._note: HeldNote | None = None
        """What is latched now."""
        self._under: dict[Path, HeldFile] = {}
        """Where it stands: also under a name that the port had before."""
        self._writer: BackgroundWriter[_Wish] = BackgroundWriter("keep HELD", self._write)

    def meet(self, port: str) -> HeldNote | None:
        """Take in that the dish is at `port` from now on; return who holds it, by what an earlier program has left.

        What is latched in this program holds under the new port too.
        """
        identity = self._identify(port)
        if identity is None:
            self._file = None
            return None
        forget_reused(self._state, identity)
        self._file = HeldFile(dish_folder(self._state, identity))
        found = self._file.read()
        if found is not None:
            self._under[self._file.path] = self._file
            self._note = self._note or found
        elif self._note is not None:
            self._put(self._file, self._note)
        return found

    def expect_another_dish(self) -> None:
        """Take in that the next port is not the present dish's: a release there leaves this one held."""
        self._under = {}

    def latch(self, note: HeldNote) -> None:
        """Latch. Any thread; never waits."""
        self._note = note
        if self._file is not None:
            self._put(self._file, note)

    def _put(self, file: HeldFile, note: HeldNote) -> None:
        # Before it is written: whoever expects another dish meanwhile must leave this one held.
        self._under[file.path] = file
        self._writer.offer(_Wish((file,), note))

    def release(self) -> None:
        """Release, wherever it was latched by this program. Any thread; never waits."""
        self._note = None
        if self._file is not None:
            under, self._under = self._under, {}
            self._writer.offer(_Wish((*under.values(), self._file), None))

    def flush(self, timeout_s: float) -> bool:
        """Wait until all is on disk; False if that took too long."""
        return self._writer.flush(timeout_s)

    def close(self, timeout_s: float) -> None:
        """Write what is left, and end."""
        self._writer.close(timeout_s)

    def _write(self, wishes: list[_Wish], _dropped: int) -> None:
        for file, note in {file.path: (file, wish.note) for wish in wishes for file in wish.files}.values():
            trouble = ""
            try:
                file.remove() if note is None else file.write(note)
            except OSError as error:
                so = "The next program finds it HELD" if note is None else "HELD ends with this program"
                what = "removed" if note is None else "written"
                trouble = f"{so}: {file.path} cannot be {what} ({error.strerror or error})."
            with contextlib.suppress(Exception):  # a listener that fails must not end the writing
                self.on_trouble(trouble)
