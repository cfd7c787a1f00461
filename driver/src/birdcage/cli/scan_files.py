"""The files of a map that `birdcage scan` writes, however the map ends."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from birdcage.cli.say import say, tell
from birdcage.skymap.map_file import find_map, read_map


class ScanFiles:
    """Writes what was heard of the map `key` into a folder; nothing without a folder."""

    def __init__(self, path: Path, folder: str | None, *, blur_place: bool) -> None:
        self._path, self._folder, self._blur_place = path, folder, blur_place
        self.key = ""

    @contextmanager
    def written(self) -> Iterator[None]:
        """Write at the end, also where the map was cut short: what was heard is on the disk."""
        try:
            yield
        finally:
            self.write()

    def write(self) -> None:
        """Write what was heard so far, and print the path of each file."""
        if not self.key:
            return
        head = find_map(self._path, self.key)
        if head is None:
            return
        say(f"Map {head.number}: {head.heard} of {head.plan.cells} directions are kept.")
        if self._folder is None:
            return
        from birdcage.skymap.map_export import write_files

        done = write_files(read_map(self._path, head.number), Path(self._folder), blur_place=self._blur_place)
        for path in done.paths:
            tell(str(path))
        for note in done.notes:
            say(note)
