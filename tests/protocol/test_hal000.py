"""The older Trav'ler's dialect against the simulated dish, and against those that it is not."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.protocol import HAL000Protocol, HAL205Protocol, get_protocol
from birdcage.rotator.values import Position
from birdcage.rotator.verdict import Grade
from birdcage.sim.port import open_port

from .judged import Judged


class Rig:
    def __init__(self, options="", address="hal000", protocol=HAL000Protocol):
        self.clock = VirtualClock()
        self.port = open_port(f"{address}?root_q=kill{options}", clock=self.clock)
        self.sent = b""
        write = self.port.write

        def note(data):
            self.sent += data
            write(data)

        self.port.write = note
        self.dish = protocol()
        self.dish.attach(self.port, self.clock)

    @property
    def truth(self):
        return self.port.dish.truth()

    def lines(self):
        return self.sent.decode().split("\r")[:-1]


@pytest.mark.parametrize("prompts", ["&prompts=named", "&prompts=alike"])
@pytest.mark.parametrize(
    "start", ["", "&searching=1", "&boot=1&boot_home_s=20", "&boot=1&boot_home_s=20&boot_line=none"]
)
def test_every_start_ends_in_the_motor_menu_with_no_search(prompts, start):
    rig = Rig(prompts + start)
    rig.dish.initialize()
    assert rig.dish.console.place == "mot"
    rig.clock.advance(5.0)
    still = rig.dish.get_position()
    rig.clock.advance(60.0)
    assert rig.dish.get_position() == still
    assert not rig.port.device.firmware.search.running
    assert rig.truth.shell_alive
    assert "kill Search" in rig.lines()
    assert not {"ngsearch", "motor", "s"} & set(rig.lines())


def test_a_search_that_does_not_run_is_no_error_and_another_refusal_is():
    rig = Rig("&no_task_text=Error: no such task")
    rig.dish.kill_search()
    rig = Rig("&no_task_text=Invalid command")
    with pytest.raises(CommandRefused, match="kill Search"):
        rig.dish.kill_search()
    assert rig.truth.menu == "mot", "and it waits for moves, not for the name of a task to kill"
    with pytest.raises(CommandRefused, match="kill Search"):
        rig.dish.initialize()


@pytest.mark.parametrize("way_in", ["initialize", "get_position", "survey", "kill_search", "stow"])
@pytest.mark.parametrize(("address", "protocol"), [
    ("g2", HAL000Protocol), ("hal205", HAL000Protocol), ("hal000", HAL205Protocol),
])  # fmt: skip
def test_another_firmware_is_refused_and_nothing_but_enter_and_help_was_sent(address, protocol, way_in):
    rig = Rig(address=address, protocol=protocol)
    for _ in range(2):
        with pytest.raises(NoReply, match=f"--firmware g2.*{address}|{address}.*Nothing was moved") as caught:
            getattr(rig.dish, way_in)()
        assert caught.value.reason == "wrong_firmware"
        rig.clock.advance(6.0)
    assert set(rig.lines()) == {"", "?"}
    assert rig.truth.shell_alive


def test_a_noisy_root_never_gets_a_q():
    for seed in range(12):
        rig = Rig(f"&seed={seed}&drop=0.02&prompts=alike")
        for ask in (rig.dish.get_position, rig.dish.survey, rig.dish.kill_search):
            try:
                ask()
            except (CommandRefused, NoReply):
                rig.clock.advance(8.0)
        assert rig.truth.shell_alive, seed


@pytest.mark.parametrize(("menu", "line", "grade", "words"), [
    ("root", "os", Grade.HARMLESS, ""), ("root", "mot", Grade.HARMLESS, ""), ("root", "motor", Grade.SETTING, "Undoc"),
    ("os", "tasks", Grade.HARMLESS, ""), ("os", "kill Search", Grade.SETTING, "next power-up"),
    ("os", "kill Shell", Grade.RUINS, "power cycle"), ("os", "kill", Grade.RUINS, "power cycle"),
    ("mot", "a 0 190", Grade.MOVES, "Nothing can cancel it"), ("root", "q", Grade.RUINS, "power cycle"),
])  # fmt: skip
def test_what_its_lines_do(menu, line, grade, words):
    verdict = Judged(HAL000Protocol(), Position(180.0, 45.0, 90.0)).judge(line, menu, homed=True)
    assert verdict.grade is grade
    assert words in verdict.consequence


def test_every_documented_command_is_listed():
    dish = Judged(HAL000Protocol(), Position(180.0, 45.0, 90.0))
    assert {command.menu for command in dish.commands} == {"root", "mot", "os", "nvs"}
    for command in dish.commands:
        if command.name != "e":
            assert dish.judge(command.name, command.menu, homed=True).listed, command


def test_the_registry_knows_it():
    assert isinstance(get_protocol("hal000"), HAL000Protocol)
