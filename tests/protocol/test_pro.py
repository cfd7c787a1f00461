"""The Trav'ler Pro's dialect against the simulated dish: its tunnel, its pace, its pages, and its lid at 75 degrees."""

from __future__ import annotations

from collections import Counter

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused, MotionRefused, NoReply
from birdcage.link.link import Link
from birdcage.protocol import HAL000Protocol, get_protocol
from birdcage.protocol.hal import TravlerProProtocol
from birdcage.protocol.hal.pages import MOST_PAGES, all_pages
from birdcage.rotator.values import Position
from birdcage.rotator.verdict import Grade
from birdcage.sim.port import SimPort, open_device

from .judged import Judged

DEADLY = "&root_q=kill&odu_q=kill"
PACED = "&odu_gap_s=0.9&motor_gap_s=0.15"
"""Lines that come too soon are lost everywhere, as far as they may be."""


class Rig:
    def __init__(self, options="", address="pro", protocol=TravlerProProtocol):
        self.clock = VirtualClock()
        paced = PACED if address == "pro" else ""
        self.device = open_device(f"{address}?seed=1{paced}{options}", clock=self.clock)
        self.sent = []
        self.dish = self.met(protocol)

    def met(self, protocol=TravlerProProtocol):
        port, dish = SimPort(self.device, "sim"), protocol()
        write = port.write

        def note(data):
            self.sent.append((self.clock.monotonic(), data.decode(), self.device.shell.menu))
            write(data)

        port.write = note
        dish.attach(Link(port, self.clock), self.clock)
        return dish

    @property
    def truth(self):
        return self.device.truth()

    def lines(self):
        return [line for _, text, _ in self.sent for line in text.split("\r")[:-1]]


@pytest.mark.parametrize("prompts", ["", "&prompts=alike"])
@pytest.mark.parametrize("left_in", ["root", "odu", "mot", "nvs", "os"])
def test_wherever_it_stands_it_is_met_and_no_q_reaches_either_unit(prompts, left_in):
    rig = Rig(DEADLY + prompts)
    rig.device.shell.menu = left_in
    rig.dish.initialize()
    assert rig.dish.console.place == "mot"
    assert rig.dish.get_position() == Position(180.0, 45.0, 90.0)
    rig.dish.survey()
    rig.dish.disconnect()
    again = rig.met()
    assert again.get_position() == Position(180.0, 45.0, 90.0)
    assert rig.truth.shell_alive
    assert rig.truth.menu == "mot"
    assert all(menu not in ("root", "odu") for _, text, menu in rig.sent if text == "q\r")
    assert Counter(rig.lines())["odu"] == (left_in == "root")
    assert [line for _, line in rig.device.shell.received] == rig.lines(), "each line that went out was heard"


def test_the_pace_that_plans_count_with_is_that_of_its_motors():
    for name in ("g2", "hal000", "hal205", "pro"):
        known = get_protocol(name)
        pace_s = known.dialect.gap_after("", known.motor_menu)
        assert known.model.least_line_interval_s == (pace_s or None)
    assert TravlerProProtocol.model.least_line_interval_s == 0.2


def test_leaving_goes_back_to_the_outdoor_unit_and_no_further():
    rig = Rig(DEADLY)
    rig.dish.enter_motor_menu()
    rig.dish.reset_to_root()
    assert rig.dish.console.place == "odu"
    with pytest.raises(CommandRefused, match=r"leaves menu `odu`.*power cycle") as caught:
        rig.dish.console.enter("root")
    assert caught.value.reason == "wrong_menu"
    with pytest.raises(CommandRefused, match="menu `odu`"):
        rig.dish.console.run("odu", "q")
    assert rig.truth.shell_alive


def test_a_power_cycle_brings_it_back_to_the_indoor_unit_and_it_is_found_there():
    rig, told = Rig(f"{DEADLY}&boot_home_s=10"), []
    rig.dish.on_restart = told.append
    rig.dish.get_position()
    rig.device.power_cycle()
    rig.clock.advance(30.0)
    assert rig.truth.menu == "root"
    assert not told
    rig.dish.initialize()
    assert told == ["The dish is back in menu `root`: only a restart is known to lead there."]
    assert rig.dish.console.place == "mot"
    rig.dish.survey()
    assert len(told) == 1
    assert rig.truth.shell_alive


def test_no_line_comes_so_soon_that_it_is_lost():
    rig = Rig()
    rig.dish.initialize()
    for degrees in (181.0, 182.0, 183.0):
        rig.dish.move_motor(0, degrees)
        rig.dish.get_position()
    rig.dish.survey()
    rig.dish.settings_table()
    heard = [line for _, line in rig.device.shell.received]
    assert heard == rig.lines(), "each line that went out was heard"
    menus = [menu for _, _, menu in rig.sent]
    gaps = [later[0] - earlier[0] for earlier, later in zip(rig.sent, rig.sent[1:], strict=False)]
    assert min(gap for gap, menu in zip(gaps, menus, strict=False) if menu != "mot") > 0.99
    assert min(gaps) > 0.19


def test_without_its_pace_it_could_not_even_be_met(monkeypatch):
    monkeypatch.setattr(TravlerProProtocol.dialect.__class__, "gap_after", lambda *_: 0.0)
    rig = Rig()
    with pytest.raises(NoReply):
        rig.dish.initialize(timeout_s=20.0)


def test_all_pages_of_its_settings_are_shown_once_and_in_order():
    rig = Rig()
    for _ in range(3):  # the listing goes on where it was left
        table = rig.dish.settings_table()
        assert [line.split(")")[0].strip() for line in table] == ["98", "99", "102", "125"]
        rig.dish.console.run("nvs", "d")
    assert rig.dish.survey().settings == {"nvs.125": "12.00"}
    assert rig.dish.survey().features == {"floor": 12.0}


PAGES = [["Index Name", " 1) A  5", " 2) B  6"], ["Index Name", " 3) C  7"], ["Index Name", " 1) A  5", " 2) B  6"]]


@pytest.mark.parametrize("first", [0, 1])
def test_a_listing_comes_round(first):
    asked = iter((PAGES[first:] + PAGES[1:])[:4])
    assert all_pages(lambda: next(asked)) == ("Index Name", " 1) A  5", " 2) B  6", " 3) C  7")
    assert all_pages(list) == ()
    whole = [" 1) A  5", " 2) B  6"]
    assert all_pages(lambda: whole) == tuple(whole)


def test_a_listing_without_end_is_given_up():
    pages = iter(range(1000))
    with pytest.raises(NoReply, match=f"{MOST_PAGES} pages"):
        all_pages(lambda: [f"{next(pages)}) A  5"])


def test_nothing_goes_beyond_75_degrees():
    rig = Rig()
    with pytest.raises(MotionRefused, match=r"beyond the limit of 75\.00"):
        rig.dish.move_motor(1, 75.5)
    rig.dish.move_motor(1, 75.0)
    rig.clock.advance(30.0)
    assert rig.truth.el_deg == pytest.approx(75.0, abs=0.02)
    assert rig.truth.shell_alive
    rig.dish.move_motor(1, 12.0)
    rig.clock.advance(30.0)
    assert rig.truth.el_deg == pytest.approx(12.0, abs=0.02)


def test_its_stow_is_asked_in_the_outdoor_unit():
    rig = Rig(DEADLY)
    rig.dish.stow()
    rig.clock.advance(60.0)
    assert rig.truth.el_deg == pytest.approx(0.0, abs=0.1)
    assert [menu for _, text, menu in rig.sent if text == "stow\r"] == ["odu"]


@pytest.mark.parametrize("address", ["g2", "hal205"])
def test_another_firmware_is_refused_and_nothing_but_enter_and_help_was_sent(address):
    rig = Rig("&root_q=kill", address)
    for ask in (rig.dish.initialize, rig.dish.get_position, rig.dish.survey):
        with pytest.raises(NoReply, match=address) as caught:
            ask()
        assert caught.value.reason == "wrong_firmware"
    assert set(rig.lines()) == {"", "?"}


@pytest.mark.parametrize(("menu", "options", "told"), [
    ("os", "", "No source says that it ends a TV search"),
    ("os", "&no_task_text=Invalid command", "TV search, should it run, was not ended. The dish refused `kill Search`"),
    ("", "", "TV search, should it run, was not ended. The dish refused `os`"),
])  # fmt: skip
def test_it_is_ready_whatever_it_says_to_the_line_that_ends_its_kins_search(menu, options, told):
    rig, heard = Rig(DEADLY + options), []
    if not menu:
        rig.device.firmware.menus["odu"]._submenus = ("mot", "nvs")
    rig.dish.initialize(heard.append)
    assert told in heard[-1]
    assert not any("is over" in line for line in heard)
    assert (rig.dish.console.place, rig.truth.menu) == ("mot", "mot")
    if told.startswith("TV search"):
        with pytest.raises(CommandRefused):
            rig.dish.kill_search()
        assert rig.truth.menu == "mot"


def test_a_menu_that_does_not_open_is_no_refusal_to_be_passed_over():
    rig = Rig(DEADLY)
    odu = rig.device.firmware.menus["odu"]
    odu._submenus, odu.commands["os"] = ("mot", "nvs"), lambda _args: (text for text in ())
    with pytest.raises(CommandRefused, match="did not go to menu `os`") as caught:
        rig.dish.initialize()
    assert caught.value.reason == "wrong_menu"
    assert rig.truth.menu == "mot"


def test_what_is_said_of_its_floor_its_search_and_its_start_is_its_own():
    pro, older = (Judged(protocol(), Position(180.0, 45.0, 90.0)) for protocol in (TravlerProProtocol, HAL000Protocol))
    for menu, line, own, kin in (
        ("nvs", "e 125 5", "floor of its firmware is 12°", "Below 15°"),
        ("nvs", "e 0127 5", "cut its two units off", "Below 15°"),
        ("os", "kill Search", "May end", "Ends the TV search"),
    ):
        assert own in pro.judge(line, menu, homed=True).consequence
        assert kin in older.judge(line, menu, homed=True).consequence
    assert "it may home" in pro.judge("reboot", "odu", homed=True).consequence
    assert "it homes" in older.judge("reboot", "root", homed=True).consequence
    known = TravlerProProtocol.model.settings_known[125]
    assert "12°" in known.danger
    assert "never lower it" in known.note


def test_it_is_refused_as_an_older_trav_ler_while_its_tunnel_is_closed():
    rig = Rig(f"{DEADLY}&gap_s=0&odu_gap_s=0&motor_gap_s=0", protocol=HAL000Protocol)
    with pytest.raises(NoReply, match="Trav'ler Pro pro") as caught:
        rig.dish.initialize()
    assert caught.value.reason == "wrong_firmware"
    assert set(rig.lines()) == {"", "?"}


@pytest.mark.parametrize(("menu", "line", "grade", "words"), [
    ("root", "odu", Grade.HARMLESS, ""), ("root", "q", Grade.RUINS, "power cycle"), ("odu", "q", Grade.RUINS, "`odu`"),
    ("odu", "mot", Grade.HARMLESS, ""), ("mot", "q", Grade.HARMLESS, ""), ("odu", "stow", Grade.RUINS, "crushed"),
    ("mot", "a 1 76", Grade.RUINS, "lock up"), ("mot", "a 1 75.01", Grade.RUINS, "lock up"),
    ("mot", "g 10 80 90", Grade.RUINS, "lock up"), ("mot", "a 1 74.9", Grade.MOVES, "Nothing can cancel it"),
    ("mot", "a 1 76.", Grade.RUINS, "lock up"), ("mot", "a 1 +76", Grade.RUINS, "lock up"),
    ("mot", "a 1 8e1", Grade.RUINS, "lock up"), ("mot", "a 01 80", Grade.RUINS, "lock up"),
    ("mot", "a 1 76x", Grade.RUINS, "lock up"), ("mot", "a 1x 76", Grade.RUINS, "lock up"),
    ("mot", "g 180 +80 0", Grade.RUINS, "lock up"), ("mot", "g 180 80", Grade.RUINS, "lock up"),
    (None, "a 1 80", Grade.RUINS, "lock up"), ("mot", "a; a 1 80", Grade.RUINS, "lock up"),
    ("mot", "a 1 75", Grade.MOVES, "Nothing can cancel it"), ("mot", "a 1 75.0", Grade.MOVES, "Nothing can cancel it"),
    ("mot", "g 80 75.0 90", Grade.MOVES, "any key ends it"), ("mot", "a 2 100", Grade.MOVES, "feed"),
    ("mot", "a 0 190", Grade.MOVES, "Nothing can cancel it"), ("os", "kill Search", Grade.SETTING, "next power-up"),
    ("root", "mot", Grade.SETTING, "Undocumented"), (None, "q", Grade.RUINS, "power cycle"),
])  # fmt: skip
def test_what_its_lines_do(menu, line, grade, words):
    verdict = Judged(TravlerProProtocol(), Position(180.0, 45.0, 90.0)).judge(line, menu, homed=True)
    assert verdict.grade is grade
    assert words in verdict.consequence


def test_how_far_beyond_its_lid_a_line_goes_is_told_and_a_sign_is_no_step():
    dish = Judged(TravlerProProtocol(), Position(180.0, 45.0, 90.0))
    for line in ("a 1 +76", "g 180 7.6e1", "a 01 76."):
        verdict = dish.judge(line, "mot", homed=True)
        assert "76.00° is 1.00° above the limit of 75.00°" in verdict.limit, line
    assert not dish.judge("a 1 75.0", "mot", homed=True).limit


@pytest.mark.parametrize(("row", "floor"), [("0", None), ("12", None), ("12.5", 12.5), ("20", 20.0), ("75", None)])
def test_a_row_that_one_readme_names_may_raise_the_floor_and_not_lower_it(row, floor):
    rig = Rig()
    rig.dish.console.run("nvs", f"e 125 {row}")
    told = rig.dish.survey()
    assert told.el_min_deg == floor
    assert told.features["floor"] == float(row), "what the dish shows is shown"


def test_every_documented_command_is_listed():
    dish = Judged(TravlerProProtocol(), Position(180.0, 45.0, 90.0))
    assert {command.menu for command in dish.commands} == {"root", "odu", "mot", "os", "nvs"}
    for command in dish.commands:
        if command.name != "e":
            assert dish.judge(command.name, command.menu, homed=True).listed, command


def test_the_registry_knows_it():
    assert isinstance(get_protocol("pro"), TravlerProProtocol)
