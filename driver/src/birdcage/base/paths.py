"""Where files live, and how to write one so that a crash leaves the old or the new, never half."""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

HOME_VARIABLE = "BIRDCAGE_HOME"
"""Environment variable that puts everything into one folder."""

CONFIG_VARIABLE = "BIRDCAGE_CONFIG"
"""Environment variable that names another `birdcage.toml`."""


@dataclass(frozen=True, slots=True)
class Paths:
    """The places of one person's files. Folders are made by whoever writes into them."""

    config_file: Path
    presets_file: Path
    places_file: Path
    """Places that were saved, each with its horizon."""
    alignments_file: Path
    """Sets of the alignment, each with its name."""
    downlinks_file: Path
    """What the user knows of who sends what, over the table that ships with birdcage."""
    cache: Path
    """What can be fetched again."""
    logs: Path
    transcripts: Path
    """Everything that passed on the wire."""
    state: Path
    """What the program remembers: history, the journal, the last turn of the cable."""
    own: Path
    """The same of the one dish that this `birdcage.toml` describes: its peaks, what it follows. The usual file's is
    `state` itself; another file is another dish, with a folder of its own."""
    backups: Path
    """Tables read from a dish before something was written to it."""
    catalogue: Path
    """The database of element sets and of what the user says about satellites."""
    passes: Path
    """A file of each pass that was followed: where the dish was sent, and where it was."""

    @property
    def journal(self) -> Path:
        """The database of faults, wear and passes."""
        return self.state / "journal.sqlite"

    @property
    def signal_recordings(self) -> Path:
        """The database of recorded signals."""
        return self.state / "signal.sqlite"

    @property
    def known_levels(self) -> Path:
        """Two levels in dB for each source of a signal that tells only counts."""
        return self.state / "levels.toml"

    @property
    def found_directions(self) -> Path:
        """Where step-track found satellites that wander, day after day."""
        return self.own / "step-track.jsonl"

    @property
    def history(self) -> Path:
        """Lines typed into the raw console."""
        return self.state / "history.txt"

    @classmethod
    def default(cls, environ: Mapping[str, str] | None = None) -> Paths:
        """Return the platform's own places, or those that `BIRDCAGE_HOME` and `BIRDCAGE_CONFIG` name."""
        environ = os.environ if environ is None else environ
        home = environ.get(HOME_VARIABLE)
        config = environ.get(CONFIG_VARIABLE)
        if home:
            paths = cls.in_folder(Path(home).expanduser())
        else:
            import platformdirs

            places = platformdirs.PlatformDirs("birdcage", appauthor=False)
            paths = cls._of(
                config=places.user_config_path,
                cache=places.user_cache_path,
                logs=places.user_log_path,
                state=places.user_state_path,
                data=places.user_data_path,
            )
        return paths.with_config(Path(config).expanduser()) if config else paths

    @classmethod
    def in_folder(cls, folder: Path) -> Paths:
        """Return places that all lie in `folder`."""
        return cls._of(
            config=folder, cache=folder / "cache", logs=folder / "logs", state=folder / "state", data=folder / "data"
        )

    @classmethod
    def _of(cls, *, config: Path, cache: Path, logs: Path, state: Path, data: Path) -> Paths:
        return cls(
            config_file=config / "birdcage.toml",
            presets_file=config / "presets.toml",
            places_file=config / "places.toml",
            alignments_file=config / "alignments.toml",
            downlinks_file=config / "downlinks.toml",
            cache=cache,
            logs=logs,
            transcripts=state / "transcripts",
            state=state,
            own=state,
            backups=data / "backups",
            catalogue=data / "catalogue.sqlite",
            passes=data / "passes",
        )

    def with_config(self, config_file: Path) -> Paths:
        """Return the same places with another `birdcage.toml`, and what belongs to its dish."""
        real = config_file.resolve()
        if real == self.config_file.resolve():
            return replace(self, config_file=config_file)
        # The name is for people; what tells one file from another is the sum.
        name = f"{real.stem}-{hashlib.sha256(str(real).encode()).hexdigest()[:8]}"
        return replace(self, config_file=config_file, own=self.state / "settings" / name)


@contextmanager
def throw_away_paths() -> Iterator[Paths]:
    """Give places in a temporary folder that is gone afterwards: for `--demo`."""
    folder = tempfile.mkdtemp(prefix="birdcage-demo-")
    try:
        yield Paths.in_folder(Path(folder))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def write_aside_and_rename(path: Path, data: bytes) -> None:
    """Write a whole file: after a crash or on a full disk `path` is the old file or the new one.

    Folders are made. Where `path` is a symbolic link, the file it points to is replaced. OSError if it can't be
    written; nothing is left aside then.
    """
    path = path.resolve()
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    aside = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if path.exists():
            shutil.copymode(path, aside)
        aside.replace(path)
    except BaseException:
        aside.unlink(missing_ok=True)
        raise
