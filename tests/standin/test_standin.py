"""The stand-in itself: what sources print of a G2, its switches, and that it shares no code with birdcage."""

from __future__ import annotations

import ast
import os
import time
from pathlib import Path

import pytest

from .dish import StandIn
from .habits import PROMPTS, Habits
from .ports import PtyDish

KNOWS_BIRDCAGE = ("bench.py", "typed.py", "conftest.py")
"""What holds the dish to birdcage; the dish itself may not."""


class Hand:
    """Types at a stand-in, on a clock that it turns itself."""

    def __init__(self, **habits):
        self.now = 0.0
        self.dish = StandIn(lambda: self.now, Habits(**habits))

    def type(self, text: str, seconds: float = 1.0) -> str:
        self.dish.hear(text.encode())
        return self.wait(seconds)

    def wait(self, seconds: float) -> str:
        end, said = self.now + seconds, b""
        while self.now < end:
            self.now = min(max(self.dish.next_event(), self.now), end)
            said += self.dish.take()
            self.now += 1e-6
        return (said + self.dish.take()).decode("latin-1")


def test_it_imports_nothing_of_birdcage():
    for path in Path(__file__).parent.glob("*.py"):
        if path.name.startswith("test_") or path.name in KNOWS_BIRDCAGE:
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            assert not any(name.startswith("birdcage") for name in names), path


def test_a_move_as_sources_print_it():
    hand = Hand()
    assert hand.wait(1) == "", "nothing is printed on connect"
    assert hand.type("q\r") == "q\r\nTRK>"
    assert hand.type("mot\r") == "mot\r\nMOT>"
    assert hand.type("a 0 200\r", 0.1) == "a 0 200\r\nAngle = 200.00\r\nMOT>"
    assert hand.dish.moves()
    hand.wait(3)
    assert hand.type("a\r") == "a\r\nAngle[0] = 200.00\r\nAngle[1] = 45.00\r\nMOT>"
    assert hand.type("q\r") == "q\r\nTRK>"
    assert hand.dish.span(0) == (pytest.approx(-180), pytest.approx(-160))


def test_the_settings_as_sources_print_them():
    hand = Hand(tracker=True)
    hand.type("nvs\r")
    assert hand.type("d 20\r").splitlines()[3] == (
        " 20) Disable Tracker Proc?            FALSE       FALSE       FALSE"
    )
    assert hand.type("e 20 1\r").splitlines()[1] == " 20) Disable Tracker Proc?           FALSE .       TRUE"
    assert hand.type("s\r").splitlines()[1] == "    Saving ... "


def test_a_blocked_second_move_is_answered_when_the_first_has_ended():
    hand = Hand(second_other="block", az_speed=10.0)
    hand.type("mot\r")
    hand.type("a 0 90\r", 0.1)
    assert hand.type("a 1 30\ra\r", 8.0) == "a 1 30\r\n", "the shell hears nothing else meanwhile"
    assert hand.wait(5).startswith("Angle = 30.00\r\nMOT>a\r\nAngle[0] = 90.00")
    assert hand.dish.where() == (pytest.approx(90), pytest.approx(30))


@pytest.mark.parametrize("rule", ["queue", "block"])
def test_a_second_move_waits_for_the_first(rule):
    hand = Hand(second_same=rule, second_other=rule, az_speed=10.0)
    hand.type("mot\r")
    hand.type("a 0 90\r", 0.1)
    said = hand.type("a 1 30\r", 2.0)
    assert ("Angle = 30.00" in said) == (rule == "queue")
    assert hand.dish.where()[1] == 45.0
    hand.wait(10)
    assert hand.dish.where() == (pytest.approx(90), pytest.approx(30))


def test_refuse_ignore_and_abort():
    for rule, ends_at in (("refuse", (90, 45)), ("ignore", (90, 45))):
        hand = Hand(second_other=rule, az_speed=10.0)
        hand.type("mot\r")
        hand.type("a 0 90\r", 0.1)
        assert ("Motor busy" in hand.type("a 1 30\r", 0.1)) == (rule == "refuse")
        hand.wait(20)
        assert hand.dish.where() == tuple(map(pytest.approx, ends_at))
    hand = Hand(second_other="abort", az_speed=10.0)
    hand.type("mot\r")
    hand.type("a 0 90\r", 2.0)
    hand.type("a 1 30\r", 5.0)
    assert 150 < hand.dish.where()[0] < 165
    assert hand.dish.where()[1] == pytest.approx(30)


@pytest.mark.parametrize("eol", ["\r", "\n", "\r\n", "\n\r"])
@pytest.mark.parametrize("prompts", PROMPTS)
def test_line_ends_and_prompts(eol, prompts):
    hand = Hand(eol=eol, prompts=prompts, echo="upper", decimals=0)
    hand.type("mot\r")
    assert hand.type("a\r") == eol.join(["A", "Angle[0] = 180", "Angle[1] = 45", PROMPTS[prompts]["mot"]])


def test_unhomed_asleep_dead():
    hand = Hand(homed=False, unhomed_as="hundredths", sleep_s=60.0, root_q="dies")
    hand.type("mot\r")
    assert "Angle[0] = 21474836.47\r\n" in hand.type("a\r")
    assert "Angle" not in hand.type("a 0 90\r").replace("a 0 90", "")
    assert "wrap_min:-42333" in hand.type("h *\r", 15)
    assert "Angle[0] = 0.00\r\nAngle[1] = 65.00" in hand.type("a\r")
    hand.wait(61)
    assert hand.type("a\r") == ""
    assert "Angle[0]" in hand.type("a\r")
    hand.type("q\r")
    assert hand.dish.root_q == 0
    hand.type("q\r")
    assert (hand.type("\r"), hand.dish.root_q) == ("", 1)
    hand.dish.reboot()
    assert hand.wait(15).endswith("TRK>")


def test_a_restart_in_mid_move_forgets_where_it_is():
    hand = Hand(az_speed=10.0)
    hand.type("mot\r")
    hand.type("a 0 90\r", 2.0)
    hand.dish.reboot()
    assert "Bootloader" in hand.type("a\r", 15)
    assert hand.type("mot\ra\r").count("2147483647") == 2
    assert not hand.dish.moves()


def test_chatter_colour_and_pieces_change_no_deed():
    hand = Hand(chatter_s=0.5, chatter_in_reply=0.5, colour=True, pieces=True, jitter_s=0.3, echo_while_busy=True)
    hand.type("mot\ra 0 90\ra 1 30\r", 10)
    assert hand.dish.where() == (pytest.approx(90), pytest.approx(30))
    assert "\x1b[32mMOT>" in hand.type("\r", 3)


def test_on_a_pty_at_its_own_speed_only():
    import termios

    with PtyDish() as served:
        descriptor = os.open(served.path, os.O_RDWR | os.O_NOCTTY)
        try:
            modes = termios.tcgetattr(descriptor)
            for speed in (termios.B9600, termios.B115200):
                modes[4] = modes[5] = speed
                termios.tcsetattr(descriptor, termios.TCSANOW, modes)
                os.write(descriptor, b"mot\r")
                os.set_blocking(descriptor, False)
                said, end = b"", time.monotonic() + (0.3 if speed == termios.B9600 else 5)
                while not said.endswith(b">") and time.monotonic() < end:
                    try:
                        said += os.read(descriptor, 100)
                    except BlockingIOError:
                        time.sleep(0.01)
                assert said == (b"" if speed == termios.B9600 else b"mot\r\nMOT>")
        finally:
            os.close(descriptor)
