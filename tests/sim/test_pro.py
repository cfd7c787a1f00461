"""The Trav'ler Pro at a terminal: two units, a tunnel, lines that come too fast, pages, and 75 degrees."""

from __future__ import annotations

import re

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.port import open_port

from .conftest import Terminal

AZ, EL = re.compile(r"AZ =(\s+\d+\.\d+)"), re.compile(r"EL =(\s+\d+\.\d+)")
"""What the public script searches for (read)."""


class Slow(Terminal):
    """A person who waits a second after each line, as the program for it does."""

    def ask(self, line, prompt="", *, within=20.0):
        heard = super().ask(line, prompt, within=within)
        return heard + self.listen(1.0)


@pytest.fixture
def pro():
    return lambda options="": Slow(options, firmware="pro")


def in_motors(dish):
    dish.ask("odu")
    dish.ask("mot")
    return dish


def test_t_pro(pro):
    dish = pro("az=180&el=45")
    for line in ("q", "", "odu"):
        dish.port.write(line.encode() + b"\r")
        assert "AZ =" not in dish.listen(1.0)
    assert dish.device.shell.menu == "odu"
    dish.port.write(b"\rq\r\rmot\r")
    dish.listen(1.0)
    assert dish.device.shell.menu == "mot", "a q in the outdoor unit does not lead back"
    dish.port.write(b"a\r")
    reply = dish.listen(1.0)
    assert (float(AZ.search(reply)[1]), float(EL.search(reply)[1])) == (180.0, 45.0)
    dish.port.write(b"a 1 76.0\r")
    assert "EL MOTOR STALLED" in dish.listen(30.0)
    assert not dish.device.truth().shell_alive
    assert dish.ask("a") == ""
    dish.device.power_cycle()
    dish.listen(300.0)
    assert dish.ask("").endswith("IDU>")


def test_it_may_only_stall_up_there(pro):
    dish = in_motors(pro("too_high=stall"))
    dish.port.write(b"a 1 80\r")
    assert "EL MOTOR STALLED" in dish.listen(30.0)
    assert 75.0 < dish.device.truth().el_deg < 76.0
    assert "AZ = " in dish.ask("a")


def test_an_obstacle_lower_down_locks_nothing_up(pro):
    dish = in_motors(pro())
    dish.port.write(b"a 1 70\r")
    dish.listen(1.0)
    dish.device.stall(1)
    assert "EL MOTOR STALLED" in dish.listen(5.0)
    assert dish.device.truth().shell_alive


def test_only_the_outdoor_unit_knows_the_motors(pro):
    dish = pro()
    assert dish.ask("?") == "?\r\nodu\r\nq\r\nIDU>"
    for line in ("mot", "nvs", "os", "a", "g 1 2 3", "stow"):
        assert dish.ask(line) == f"{line}\r\nInvalid command.\r\nIDU>"
    assert dish.ask("odu") == "odu\r\nODU>"
    assert dish.ask("?") == "?\r\nmot\r\nos\r\nnvs\r\nreboot\r\nstow\r\nq\r\nODU>"
    assert dish.ask("odu") == "odu\r\nInvalid command.\r\nODU>"
    for menu in ("mot", "os", "nvs"):
        assert dish.ask(menu) == f"{menu}\r\n{menu.upper()}>"
        assert dish.ask("q") == "q\r\nODU>"


@pytest.mark.parametrize(("q", "menu", "alive"), [
    ("error", "odu", True), ("ignore", "odu", True), ("leave", "root", True), ("kill", "root", False),
])  # fmt: skip
def test_q_in_the_outdoor_unit(pro, q, menu, alive):
    dish = pro(f"odu_q={q}")
    dish.ask("odu")
    assert ("Invalid command." in dish.ask("q")) is (q == "error")
    truth = dish.device.truth()
    assert (truth.menu, truth.shell_alive) == (menu, alive)


@pytest.mark.parametrize(("gap", "menu"), [(0.5, "root"), (0.95, "odu")])
def test_a_line_that_comes_too_soon_is_lost_whole(pro, gap, menu):
    dish = pro()
    dish.port.write(b"\r")
    dish.listen(gap)
    dish.port.write(b"odu\r")
    heard = dish.listen(2.0)
    assert dish.device.shell.menu == menu
    assert ("odu" in heard) is (menu == "odu")


def test_a_burst_of_lines_leaves_the_first_alone(pro):
    dish = pro()
    dish.port.write(b"odu\rq\r\rmot\r")
    assert dish.listen(2.0) == "odu\r\nODU>"


def test_among_the_motors_it_hears_faster(pro):
    dish = in_motors(pro())
    dish.port.write(b"a\r")
    dish.listen(0.2)
    dish.port.write(b"a\r")
    assert "AZ = " in dish.listen(0.5)


def test_settings_come_in_pages_and_again_from_the_first(pro):
    dish = pro()
    dish.ask("odu")
    dish.ask("nvs")

    def page():
        return [line.split(")")[0].strip() for line in dish.ask("d").splitlines()[1:-1]]

    assert [page(), page(), page()] == [["98", "99", "102"], ["125"], ["98", "99", "102"]]
    assert dish.ask("e 125 0").splitlines()[1].endswith("0.00")
    assert dish.ask("d 102").splitlines()[1].endswith("90.00")


def test_its_limits_and_stow_are_settings(pro):
    dish = pro("below_floor=refuse&boot_home_s=10")
    dish.ask("odu")
    dish.ask("nvs")
    for line in ("e 125 20", "e 102 60", "e 99 30", "s", "q"):
        dish.ask(line)
    dish.ask("reboot")
    dish.listen(100.0)
    dish.ask("odu")
    dish.ask("os")
    dish.ask("kill Search")
    dish.ask("q")
    dish.ask("mot")
    assert "Angle out of range." in dish.ask("a 1 19")
    assert "Angle out of range." in dish.ask("a 1 61")
    dish.ask("q")
    dish.ask("stow")
    dish.listen(60.0)
    assert dish.device.truth().el_deg == pytest.approx(30.0, abs=0.1)


def test_one_that_does_not_home_knows_where_it_stands(pro):
    dish = pro("boot=1&homes=0")
    before = dish.device.truth()
    dish.listen(60.0)
    assert dish.device.truth().homed
    assert dish.device.truth().az_deg == before.az_deg


@pytest.mark.parametrize("baud", [9600, 57600, 115200])
def test_it_speaks_at_any_rate(baud):
    clock = VirtualClock()
    port = open_port("pro", clock=clock, baud=baud)
    port.write(b"\r")
    clock.advance(1.0)
    assert port.read() == b"\r\nIDU>"


def test_a_search_stays_below_its_stop(pro):
    dish = pro("searching=1&search_finds=0")
    for _ in range(200):
        dish.listen(5.0)
        assert dish.device.truth().shell_alive
        assert dish.device.truth().el_deg <= 75.0
