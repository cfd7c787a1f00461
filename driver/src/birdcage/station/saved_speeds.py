"""Speeds that a pursuit has changed, on disk: where the program dies meanwhile, the next one puts them back."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path

from birdcage.base.errors import MotionRefused
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.reason import Reason
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file

FILE = "speeds.json"


class SavedSpeeds:
    """`speeds.json` in the state folder: what each motor goes at by itself, of one dish at one port."""

    def __init__(self, folder: Path, port: str, firmware: str) -> None:
        self._path = folder / FILE
        self._dish = {"port": port, "firmware": firmware}

    def read(self) -> dict[int, float]:
        """Return the speeds to be put back (motor number to deg/s): none of another dish, or of a damaged file."""
        try:
            values = clean_all(json.loads(read_user_file(self._path)))
            if {key: values[key] for key in self._dish} != self._dish:
                return {}
            speeds = {int(motor): float(speed) for motor, speed in values["speeds_deg_s"].items()}
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return {}
        return speeds if all(math.isfinite(speed) and speed > 0.0 for speed in speeds.values()) else {}

    def write(self, speeds: Mapping[int, float]) -> None:
        """Write what is to be put back, before it is changed. MotionRefused (`controller`) where that can't be done."""
        try:
            write_aside_and_rename(self._path, json.dumps({**self._dish, "speeds_deg_s": speeds}).encode())
        except OSError as error:
            raise MotionRefused(
                f"{self._path} cannot be written ({error.strerror or error}). It must hold the motors' own speeds, "
                "so they were not changed. Another controller changes none.",
                reason=Reason.CONTROLLER,
            ) from error

    def clear(self) -> None:
        """All is as it was. A file that cannot be removed puts the same speeds back once more: no harm."""
        try:
            self._path.unlink(missing_ok=True)
        except OSError:
            return
