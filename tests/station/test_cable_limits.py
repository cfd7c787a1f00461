"""The cable limits of `birdcage.toml`, from the file to the wire: the dish knows only its own."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import load
from birdcage.base.errors import MotionRefused
from birdcage.base.paths import Paths
from birdcage.sim.port import open_device
from birdcage.station.build import open_session
from birdcage.station.requests import Goto, Home, Jog
from birdcage.station.state import LinkPhase


class FromFile:
    """A station as a program builds it from its settings, and a simulated G2."""

    def __init__(self, folder, text):
        (folder / "birdcage.toml").write_text(text)
        self.clock = VirtualClock()
        self.device = open_device(f"g2?id={folder.name}", clock=self.clock)
        self.session = open_session(
            port=f"sim:g2?id={folder.name}", firmware="g2", baud=None, settings=load(folder / "birdcage.toml", {}),
            paths=Paths.in_folder(folder), clock=self.clock, survey=False,
        )  # fmt: skip
        self.session.step(3.0)
        assert self.session.station.state.link.state is LinkPhase.UP

    def do(self, request, seconds=60.0):
        future = self.session.station.submit(request)
        self.session.step(seconds)
        return future.result(0)

    @property
    def cable_deg(self):
        return self.device.truth().cable_deg

    def moves(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received if line.startswith("a ")]


@pytest.fixture
def from_file(tmp_path):
    opened = []

    def build(text):
        opened.append(FromFile(tmp_path, text))
        return opened[-1]

    yield build
    for each in opened:
        each.session.close()


def test_a_turn_beyond_the_user_s_stop_is_refused_and_nothing_is_sent(from_file):
    dish = from_file("[motion]\ncable_min_deg = -200\ncable_max_deg = 20\n")
    dish.do(Home("you"))
    with pytest.raises(MotionRefused, match="beyond its stop") as refused:
        dish.do(Goto(110, 45, "you"))
    assert refused.value.reason == "wrap"
    assert dish.moves() == []
    assert dish.do(Goto(170, 45, "you")).cable_deg == pytest.approx(-190, abs=0.1)
    with pytest.raises(MotionRefused, match="beyond its stop"):
        dish.do(Jog(-15.0, 0.0, "you"))
    assert dish.cable_deg == pytest.approx(-190, abs=0.1)


def test_the_way_that_the_dish_takes_by_itself_counts_not_another_that_would_fit(from_file):
    """From -300 to azimuth 355 it goes on to -365, and of the user's stop at -350 it knows nothing."""
    dish = from_file("[motion]\ncable_min_deg = -350\n")
    dish.do(Home("you"))
    for az_deg in (200, 60):
        dish.do(Goto(az_deg, 45, "you"))
    sent = dish.moves()
    with pytest.raises(
        MotionRefused, match=r"15\.0\d° beyond its stop at -350\.00° .*by way of azimuth 207°"
    ) as refused:
        dish.do(Goto(355, 45, "you"))
    assert refused.value.limit_deg == -350.0
    assert dish.moves() == sent
    dish.do(Goto(207, 45, "you"))
    assert dish.do(Goto(355, 45, "you")).cable_deg == pytest.approx(-5, abs=0.1)
    assert dish.cable_deg == pytest.approx(-5, abs=0.1)


@pytest.mark.parametrize(("limits", "az_deg"), [("cable_min_deg = -420", 298), ("cable_max_deg = 10", 20)])
def test_an_unknown_turn_is_refused_where_one_of_them_leads_beyond(from_file, limits, az_deg):
    dish = from_file(f"[motion]\n{limits}\n")
    with pytest.raises(MotionRefused, match=r"its turn is unknown.*Home the dish"):
        dish.do(Goto(az_deg, 45, "you"))
    assert [line for line in dish.moves() if line != "a"] == []
