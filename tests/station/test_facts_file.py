"""`facts.json` on a disk that is full, or where a file is in the way: nothing that was known is lost."""

from __future__ import annotations

import subprocess
import sys

import pytest

ON_A_FULL_DISK = """
import resource, sys
from datetime import UTC, datetime
from pathlib import Path
from birdcage.base.errors import ConfigError
from birdcage.rotator.own import OwnFacts
from birdcage.station.facts_file import FactsFile

utc, folder = datetime(2026, 11, 22, tzinfo=UTC), Path(sys.argv[1])
files = FactsFile(folder / "new/facts.json", "g2"), FactsFile(folder / "old/facts.json", "g2")
files[0].write(OwnFacts().that_waits(utc))
files[0].set_play(0.05, None, utc)
(folder / "old").mkdir()
(folder / "old/moves.json").write_text('{"firmware": "g2", "second_move": "block"}')
kept = {each: each.read_bytes() for each in folder.glob("*/*")}
assert len(kept) == 2, kept
resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))  # the kernel takes so many bytes of a file, and no more
set_new, set_old = (lambda file=file: file.set_play(0.06, None, utc) for file in files)
for write in (set_new, files[0].forget_gear, set_old):
    try:
        write()
    except ConfigError as error:
        print(error)
assert {each: each.read_bytes() for each in folder.glob("*/*")} == kept
print(*(sorted(file.read().facts) for file in files))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no such limit there")
def test_a_disk_that_is_full_in_mid_write_leaves_what_was_known(tmp_path):
    done = subprocess.run([sys.executable, "-c", ON_A_FULL_DISK, tmp_path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("facts.json can't be written (File too large): nothing was kept.") == 3, done.stdout
    new = "['azimuth.play_deg', 'second_other', 'second_same']"
    assert done.stdout.splitlines()[-1] == f"{new} ['second_other', 'second_same']"
