"""An attached program has changed birdcage.toml: the program that has the port reads it again."""

from __future__ import annotations

import pytest
from birdcage.base.config import edit, load
from birdcage.base.errors import BirdcageError, CommandRefused
from birdcage.base.reason import Reason
from birdcage.station.requests import Goto, ReloadSettings
from birdcage.station.settings import SettingsFile

from .conftest import Bench


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "birdcage.toml"
    path.write_text("[motion]\nmax_elevation_deg = 60.0\n")
    return path


@pytest.fixture
def bench(file):
    bench = Bench(options={"file": SettingsFile(file, lambda: load(file, environ={}))})
    bench.connect(6.0)
    return bench


def test_what_was_written_counts_at_once(bench, file):
    edit(file, {"motion.max_elevation_deg": 50.0})
    bench.do(ReloadSettings(str(file)))
    assert bench.state.el_max_deg == 50.0


def test_another_name_of_the_file_will_do(bench, file, tmp_path):
    (tmp_path / "link").symlink_to(file)
    edit(file, {"motion.max_elevation_deg": 51.0})
    bench.do(ReloadSettings(str(tmp_path / "link")))
    assert bench.state.el_max_deg == 51.0


def test_a_program_that_reads_another_file_says_which(bench, file, tmp_path):
    with pytest.raises(CommandRefused, match="reads") as refused:
        bench.do(ReloadSettings(str(tmp_path / "another.toml")))
    assert str(file) in str(refused.value)
    assert bench.state.el_max_deg == 65.0


def test_a_program_that_reads_none_says_so():
    bench = Bench()
    bench.connect(6.0)
    with pytest.raises(CommandRefused, match="Start it again"):
        bench.do(ReloadSettings("/birdcage.toml"))


def test_nothing_is_taken_over_while_the_dish_moves(bench, file):
    edit(file, {"motion.max_elevation_deg": 50.0})
    bench.station.submit(Goto(200.0, 45.0, "you"))
    bench.step(0.5)
    with pytest.raises(BirdcageError) as refused:
        bench.do(ReloadSettings(str(file)))
    assert refused.value.reason is Reason.MOVING
    assert bench.state.el_max_deg == 65.0
