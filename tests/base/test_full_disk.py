"""A disk that is full in the middle of writing: what a person has written down is as it was."""

from __future__ import annotations

import subprocess
import sys

import pytest

ON_A_FULL_DISK = """
import resource, sys
from pathlib import Path
from birdcage.base.alignments import AlignmentSet, keep_set
from birdcage.base.config import edit
from birdcage.base.errors import ConfigError
from birdcage.base.places import Place, add_place
from birdcage.base.presets import Preset, add_preset

folder = Path(sys.argv[1])
writers = (
    lambda: edit(folder / "birdcage.toml", {"dish.port": "/dev/ttyUSB0"}),
    lambda: add_preset(folder / "presets.toml", Preset("mast", 10.0, 40.0)),
    lambda: keep_set(folder / "alignments.toml", AlignmentSet("roof", 1.0, 2.0)),
    lambda: add_place(folder / "places.toml", Place("field", 52.0, 5.0)),
)
for writer in writers:
    writer()
kept = {each: each.read_bytes() for each in folder.iterdir()}
assert len(kept) == 4, kept
writers = (
    lambda: edit(folder / "birdcage.toml", {"dish.port": "/dev/ttyUSB1"}),
    lambda: add_preset(folder / "presets.toml", Preset("tower", 10.0, 40.0)),
    lambda: keep_set(folder / "alignments.toml", AlignmentSet("roof", 3.0, 2.0)),
    lambda: add_place(folder / "places.toml", Place("hill", 52.0, 5.0)),
)
resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))  # the kernel takes so many bytes of a file, and no more
for writer in writers:
    try:
        writer()
    except ConfigError as error:
        print(error)
assert {each: each.read_bytes() for each in folder.iterdir()} == kept
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no such limit there")
def test_a_disk_that_is_full_in_mid_write_leaves_every_file_whole(tmp_path):
    done = subprocess.run([sys.executable, "-c", ON_A_FULL_DISK, tmp_path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("can't be written (File too large)") == 4, done.stdout
