"""The presets as the app has them: read once after the first frame, changed through the file, one deletion undone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from birdcage.base.errors import ConfigError
from birdcage.base.presets import Preset, Presets, add_preset, delete_preset, load_presets, replace_preset


class PresetBook:
    """Each change returns a sentence for a person. ConfigError says why nothing was changed."""

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._presets = Presets(path or Path())
        self._deleted: tuple[Preset, int] | None = None

    @property
    def entries(self) -> tuple[Preset, ...]:
        """What can be gone to."""
        return self._presets.entries

    @property
    def problem(self) -> str:
        """Why nothing can be changed, as a sentence; empty when it can."""
        if self._path is None:
            return "This app has no presets file."
        problems = self._presets.problems
        return f"{problems[0]} Fix or move that file. Until then presets can't be saved." if problems else ""

    @property
    def deleted(self) -> str:
        """The name of what undo would bring back; empty when there is nothing."""
        return "" if self._deleted is None else self._deleted[0].name

    def load(self) -> None:
        """Read the file."""
        if self._path is not None:
            self._presets = load_presets(self._path)

    def add(self, preset: Preset) -> str:
        """Keep another one."""
        self._change(lambda path: add_preset(path, preset))
        return f'Saved "{preset.name}" at {preset.az_deg:.2f}°/{preset.el_deg:.2f}°.'

    def replace(self, name: str, preset: Preset) -> str:
        """Put it in the place of the one called `name`."""
        self._change(lambda path: replace_preset(path, name, preset))
        return f'Changed "{preset.name}": {preset.az_deg:.2f}°/{preset.el_deg:.2f}°.'

    def delete(self, name: str) -> str:
        """Take it out, and remember it and its place."""
        index, preset = next((i, p) for i, p in enumerate(self.entries) if p.name == name)
        self._change(lambda path: delete_preset(path, name))
        self._deleted = preset, index
        return f'Deleted "{name}". u restores it.'

    def undo(self) -> str:
        """Bring back the one that was deleted last."""
        if self._deleted is None:
            raise ConfigError("No deleted presets.")
        preset, index = self._deleted
        self._change(lambda path: add_preset(path, preset, index))
        self._deleted = None
        return f'Restored "{preset.name}".'

    def _change(self, change: Callable[[Path], Presets]) -> None:
        if self._path is None:
            raise ConfigError(self.problem)
        try:
            self._presets = change(self._path)
        except ConfigError:
            self.load()  # somebody else may have written it
            raise
