"""The Trav'ler's dialect against the simulated dish: every start, every motion, every refusal."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BelowFloor, CommandRefused, MotionRefused, NoReply, PositionUnknown
from birdcage.console.codec import MARK
from birdcage.protocol import CarryoutG2Protocol, HAL205Protocol, get_protocol
from birdcage.sim.port import open_port


class Rig:
    def __init__(self, options: str = "", protocol: type = HAL205Protocol, address: str = "hal205") -> None:
        self.clock = VirtualClock()
        self.port = open_port(f"{address}?root_q=kill&{options}".rstrip("&"), clock=self.clock)
        self.dish = protocol()
        self.sent = b""
        write = self.port.write

        def note(data: bytes) -> None:
            self.sent += data
            write(data)

        self.port.write = note
        self.told: list[str] = []
        self.dish.attach(self.port, self.clock)

    @property
    def truth(self):
        return self.port.dish.truth()

    @property
    def elapsed_s(self) -> float:
        return self.clock.monotonic() - 1000.0

    def lines(self) -> list[str]:
        return self.sent.decode().split("\r")[:-1]


PROMPTS = pytest.mark.parametrize("prompts", ["prompts=named", "prompts=alike"])
"""The two kinds of prompts that there may be."""


@PROMPTS
@pytest.mark.parametrize(
    ("start", "most_s"),
    [
        ("", 7.0),
        ("searching=1", 7.0),
        ("searching=1&search_text=Sweep", 25.0),
        ("searching=1&search_text=Sweep&search_speed=90", 40.0),
        ("boot=1", 150.0),
        ("boot=1&boot_line=nogps", 150.0),
        ("boot=1&boot_line=none", 150.0),
    ],
)
def test_every_start_ends_in_the_motor_menu_with_no_search(prompts, start, most_s):
    rig = Rig(f"{prompts}&{start}")
    rig.dish.initialize(rig.told.append)
    assert rig.elapsed_s < most_s
    assert rig.dish.console.place == "motor"
    rig.clock.advance(5.0)
    still = rig.dish.get_position()
    rig.clock.advance(60.0)
    assert rig.dish.get_position() == still
    assert rig.truth.shell_alive
    assert rig.told


def test_while_the_boot_log_streams_nothing_is_asked_once_it_was_heard():
    rig = Rig("boot=1")
    rig.dish.initialize()
    assert len(rig.lines()) < 30


def test_a_deadlocked_shell_is_said_to_need_a_power_cycle():
    rig = Rig("unhomed=1&unhomed_move=deadlock")
    rig.dish.enter_motor_menu()
    with pytest.raises(NoReply):
        rig.dish.console.run("motor", "a 0 10")
    with pytest.raises(NoReply, match="power cycle") as caught:
        rig.dish.initialize(timeout_s=30.0)
    assert caught.value.reason in {"silent", "echo"}
    assert rig.elapsed_s < 90.0


@PROMPTS
def test_connected_before_the_first_second_and_a_half_is_over(prompts):
    rig = Rig(prompts)
    rig.dish.get_position()
    assert rig.elapsed_s < 1.5
    before, began = len(rig.lines()), rig.elapsed_s
    rig.dish.get_position()
    assert rig.lines()[before:] == ["a"]
    assert rig.elapsed_s - began < 0.1


def test_positions_limits_and_moves():
    rig = Rig("az=180&el=45&sk=90")
    position = rig.dish.get_position()
    assert (position.azimuth, position.elevation, position.skew) == (180.0, 45.0, 90.0)
    rig.dish.move_motor(0, 190.0)
    rig.dish.move_motor(1, 50.0)
    with pytest.raises(BelowFloor):
        rig.dish.move_motor(1, 14.0)
    with pytest.raises(MotionRefused):
        rig.dish.move_motor(0, 361.0)
    rig.clock.advance(30.0)
    assert (rig.truth.az_deg, rig.truth.el_deg) == pytest.approx((190.0, 50.0), abs=0.02)


def test_the_skew_turns_and_knows_its_range():
    rig = Rig("sk=90")
    rig.dish.move_motor(2, 120.0)
    rig.clock.advance(20.0)
    assert rig.dish.get_position().skew == pytest.approx(120.0, abs=0.02)
    for wrong in (181.0, -1.0, float("nan")):
        with pytest.raises(MotionRefused):
            rig.dish.move_motor(2, wrong)
    rig.dish.move_motor(2, 100.0)
    assert rig.lines()[-1] == "a 2 100.00"


def test_a_slew_names_the_skew_and_cannot_go_without():
    rig = Rig("sk=90")
    with pytest.raises(CommandRefused, match="did not report its skew"):
        rig.dish.begin_slew(100.0, 60.0, None)
    rig.dish.begin_slew(100.0, 60.0, 120.0)
    assert rig.lines()[-1] == "g 100.00 60.00 120.00"


@PROMPTS
@pytest.mark.parametrize("key", ["abort_key=swallow", "abort_key=keep"])
@pytest.mark.parametrize("prompt", ["abort_prompt=at_once", "abort_prompt=at_rest"])
def test_two_enters_stop_a_slew_and_are_answered(prompts, key, prompt):
    rig = Rig(f"{prompts}&{key}&{prompt}&az=10&el=45")
    rig.dish.get_position()
    rig.dish.begin_slew(200.0, 60.0, 90.0)
    assert not rig.dish.slew_is_over()
    rig.clock.advance(3.0)
    assert rig.truth.moving
    rig.dish.interject(rig.dish.abort_lines())
    assert len(rig.dish.console.settle(2.0)) == 2
    assert rig.dish.slew_is_over()
    rig.clock.advance(1.0)
    assert not rig.truth.moving
    assert rig.dish.get_position().azimuth < 200.0


def test_a_slew_that_arrives_gives_the_prompt_back():
    rig = Rig("az=10&el=45")
    rig.dish.get_position()
    before = len(rig.lines())
    rig.dish.begin_slew(60.0, 50.0, 90.0)
    while not rig.dish.slew_is_over():
        rig.clock.advance(0.5)
        assert rig.elapsed_s < 60.0
    assert rig.lines()[before:] == ["g 60.00 50.00 90.00"]
    assert rig.truth.az_deg == pytest.approx(60.0, abs=0.02)


def test_a_slew_that_the_dish_refuses_says_so():
    rig = Rig("el_max=70")
    rig.dish.get_position()
    rig.dish.begin_slew(60.0, 80.0, 90.0)
    rig.clock.advance(1.0)
    with pytest.raises(CommandRefused, match="out of range"):
        rig.dish.slew_is_over()
    assert rig.dish.slew_is_over()


def test_a_dish_that_is_not_homed_has_no_position():
    rig = Rig("unhomed=1")
    with pytest.raises(PositionUnknown):
        rig.dish.get_position()


def test_what_it_tells_and_what_it_has_not():
    rig = Rig()
    survey = rig.dish.survey()
    assert survey.settings == {"nvs.125": "15.00", "nvs.127": "15.00"}
    assert (survey.el_min_deg, survey.identity) == (15.0, {})
    assert survey.features == {"floor": 15.0, "floor.search": 15.0}
    assert any("127)" in line for line in rig.dish.settings_table())
    for lacking in (
        rig.dish.restore_search, rig.dish.get_rssi, rig.dish.engage_motors, rig.dish.release_motors,
        lambda: rig.dish.home_motor(0), lambda: rig.dish.set_speed(0, 10.0),
    ):  # fmt: skip
        with pytest.raises(CommandRefused) as caught:
            lacking()
        assert caught.value.reason == "unsupported"


def test_stow_is_asked_at_the_root():
    rig = Rig("az=90&el=45")
    rig.dish.get_position()
    rig.dish.stow()
    rig.clock.advance(60.0)
    assert rig.truth.el_deg == pytest.approx(0.0, abs=0.1)
    assert rig.dish.get_position().elevation == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("ways_in", ["initialize", "get_position", "enter_motor_menu", "survey", "kill_search", "stow"])
def test_a_g2_is_refused_by_name_on_every_way_in(ways_in):
    rig = Rig(address="g2")
    for _ in range(3):
        with pytest.raises(NoReply, match="--firmware g2") as caught:
            getattr(rig.dish, ways_in)()
        assert caught.value.reason == "wrong_firmware"
        rig.clock.advance(6.0)
    assert rig.truth.shell_alive
    assert set(rig.lines()) == {"", "?"}


@pytest.mark.parametrize("menu", ["mot", "dvb", "nvs", "os", "step", "eeprom", "gpio", "peak"])
def test_a_g2_in_a_submenu_is_not_moved_and_its_shell_lives(menu):
    rig = Rig(address="g2")
    rig.port.write(menu.encode() + b"\r")
    rig.clock.advance(1.0)
    for _ in range(3):
        with pytest.raises(NoReply) as caught:
            rig.dish.get_position()
        assert caught.value.reason in {"wrong_firmware", "garbage"}
        assert ">" in str(caught.value)
        rig.clock.advance(6.0)
    assert rig.truth.shell_alive
    assert set(rig.lines()) <= {menu, "", MARK, "?", "q", "a"}


@PROMPTS
def test_a_dish_that_was_left_in_its_motor_menu_is_asked_there_at_once(prompts):
    rig = Rig(prompts)
    rig.port.write(b"motor\r")
    rig.clock.advance(1.0)
    rig.port.read()
    began = rig.clock.monotonic()
    assert rig.dish.get_position().azimuth == pytest.approx(180.0)
    assert rig.clock.monotonic() - began < 1.5
    assert "q" not in rig.lines()


@pytest.mark.parametrize("options", ["prompts=alike", "prompt_root=HAL>"])
def test_the_g2_dialect_names_the_prompt_that_it_does_not_know(options):
    rig = Rig(options, protocol=CarryoutG2Protocol)
    with pytest.raises(NoReply, match=r"prompt `(HAL)?>`.*--firmware hal205") as caught:
        rig.dish.initialize()
    assert caught.value.reason == "wrong_firmware"
    assert rig.elapsed_s < 15.0
    with pytest.raises(NoReply):
        rig.dish.move_motor(0, 100.0)
    assert set(rig.lines()) == {""}


def test_the_registry_knows_it():
    assert isinstance(get_protocol("hal205"), HAL205Protocol)
