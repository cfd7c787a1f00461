"""The guided calibration in plain lines, with what a person would type at the dish."""

from __future__ import annotations

import queue

import pytest
from birdcage.base.config import load
from birdcage.cli.calibrate_talk import CalibrateTalk
from birdcage.station.requests import Release


class Dish:
    """The command's hold on the session: `look` lets a moment pass."""

    def __init__(self, garden):
        self._garden = garden
        self.progress = self

    def look(self):
        self._garden.session.step(0.1)

    def show(self, text):
        pass

    def clear(self):
        pass


class Person:
    """Types one line after the other, when the dish has had a moment; a callable does something else first."""

    def __init__(self, *lines):
        self._lines, self._waits = list(lines), 0

    def next(self):
        self._waits += 1
        if self._waits % 30:
            raise queue.Empty
        if not self._lines:
            return None
        line = self._lines.pop(0)
        return line() if callable(line) else line


@pytest.fixture
def talk(garden, capsys):
    def talk(*lines):
        capsys.readouterr()
        CalibrateTalk(garden.guide, Dish(garden), Person(*lines), garden.paths).run()
        return capsys.readouterr()

    return talk


def test_led_to_an_object_nudged_and_kept(garden, talk):
    def right():
        turn = garden.guide.view().expected[0] - garden.device.truth().beam_az_deg
        return f"{'r' if turn > 0 else 'l'} {min(abs(turn) * 0.7, 9.0):.2f}"

    told = talk("n", right, "l 0.2", "u", "", "q")
    assert "1  " in told.err
    assert "the expected error over the sky falls" in told.err
    assert "° right, " in told.err
    assert "Peak 1 is kept: " in told.err
    assert "Offsets only." in told.err
    assert len(garden.guide.peaks) == 1
    assert garden.guide.peaks[0].dish_el_deg != pytest.approx(garden.guide.peaks[0].true_el_deg, abs=0.1)


def test_another_object_by_name_its_fit_and_a_set(garden, talk):
    told = talk("g 101W", "", "g 119W", "", "f", "a Garden", "x 1", "q")
    assert [peak.target for peak in garden.guide.peaks] == ["119°W EchoStar 14"]
    assert "azimuth offset" in told.out
    assert "Saved and in use: Garden." in told.err
    assert load(garden.paths.config_file, {}).alignment.active == "Garden"
    assert "1 left" in told.err


def test_what_is_typed_wrong_is_said_and_nothing_moves(garden, talk):
    before = garden.device.truth().az_deg
    told = talk("", "z", "n 99", "n x", "u nonsense", "r 30", "g nothing so called", "a", "f")
    for words in (
        "No object is chosen", "Unknown answer. Type ?", "objects in the list", "'x' is not a number of the list",
        "at most 10 degrees", "No target is called", "nothing to apply", "No peaks yet",
    ):  # fmt: skip
        assert words in told.err, told.err
    assert garden.device.truth().az_deg == before
    assert garden.guide.peaks == ()


def test_stop_is_told_and_no_peak_is_taken_of_it(garden, talk):
    def stop():
        garden.guide.go()
        garden.session.step(0.5)
        garden.session.station.stop("test")
        return ""

    told = talk("n", stop, "g", "q")
    assert "HELD" in told.err
    garden.session.station.submit(Release("test"))
    garden.run(1.0)
