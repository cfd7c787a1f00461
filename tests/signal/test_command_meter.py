"""A program that prints levels: what counts as one, what is said of one that lies, and that it ends with birdcage."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from birdcage.base.clock import RealClock
from birdcage.signal.command_meter import CommandMeter, rtl_power_level
from birdcage.signal.meter import level_in
from birdcage.signal.output_lines import OutputLines

from tests.signal.reading import end_of, level, opened, wait_until
from tests.signal.stand_ins import program

CLOCK = RealClock()


def test_a_line_is_a_level_and_what_is_none_is_passed_over():
    text = "import time\nfor each in ('warming up', '-41.5 dB', 'nan', '-40.5'):\n print(each)\n time.sleep(0.05)"
    text += "\ntime.sleep(9)"
    with opened(CommandMeter(program(text), CLOCK, dwell_s=0.5)) as meter:
        first, second = level(meter), level(meter)
    assert (first.value, second.value, first.dwell_s) == (-41.5, -40.5, 0.5)
    assert first.at < CLOCK.monotonic() - 0.25, "in the middle of what it measured"


def test_one_that_is_asked_measures_after_the_question():
    text = "import sys\nprint(99.0)\nfor n, _ in enumerate(sys.stdin):\n print(n)"
    with opened(CommandMeter(program(text), CLOCK, ask_every_s=0.01)) as meter:
        asked = CLOCK.monotonic()
        told = level(meter)
        # What it prints unasked answers no question of ours.
        assert told.at - told.dwell_s / 2.0 >= asked - 0.001
        later = [level(meter).value for _ in range(3)]
    assert later == sorted(later)


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("no-such-program-here -x", "There is no program 'no-such-program-here'"),
        ("'", "can't be read"),
        (program("print('device busy'); raise SystemExit(3)"), "has ended with exit status 3: device busy"),
        (program("import os; os.write(1, bytes(range(128, 256)) * 100)"), "has ended with exit status 0"),
    ],
)
def test_a_command_that_is_none_or_dies_says_so(command, words):
    meter = CommandMeter(command, CLOCK)
    assert words in end_of(meter)


@pytest.mark.parametrize("line", ["nan", "-inf", "level: -41", "--41", "\\xff\\xfe", "1e999"])
def test_a_command_whose_lines_hold_no_level_says_what_it_prints(line):
    text = f"import os, time\nwhile True:\n os.write(1, b'{line}\\n')\n time.sleep(0.02)"
    said = end_of(CommandMeter(program(text), CLOCK, patience_s=0.5))
    assert " prints no level, but '" in said
    assert said.isprintable()


def test_one_that_answers_three_times_is_believed_once_for_each_question():
    text = "import sys\nfor n, _ in enumerate(sys.stdin):\n print(n)\n print(77)\n print(88)"
    with opened(CommandMeter(program(text), CLOCK, ask_every_s=0.1)) as meter:
        told = [level(meter) for _ in range(5)]
    assert [each.value for each in told] == [0, 1, 2, 3, 4], "what was left over answers no later question"
    assert all(each.dwell_s >= 0.0 for each in told)


def test_one_is_asked_as_often_as_it_was_wished():
    text = "import sys\nfor n, _ in enumerate(sys.stdin):\n print(n)"
    with opened(CommandMeter(program(text), CLOCK, ask_every_s=0.06)) as meter:
        first = level(meter)
        assert [meter.read(0.2).value for _ in range(10)] == [*range(1, 11)]
        assert level(meter).at - first.at < 11 * 0.12


def test_a_flood_is_thinned_and_its_levels_are_of_now():
    text = "import sys, time\nwhile True:\n sys.stdout.write(f'{time.monotonic()}\\n' * 1000)"
    with opened(CommandMeter(program(text), CLOCK)) as meter:
        level(meter)
        begun = CLOCK.monotonic()
        told = [level(meter) for _ in range(30)]
        assert CLOCK.monotonic() - begun > 30 * 0.009
        assert max(each.at - each.value for each in told) < 0.5
    assert len({each.value for each in told}) > 20


@pytest.mark.parametrize("piece", ["1", "4 ", "-41.5 dB,"])
def test_a_line_without_an_end_is_no_level_wherever_it_is_cut(piece):
    text = f"import sys, time\nwhile True:\n sys.stdout.write({piece!r} * 3000)\n time.sleep(0.001)"
    with opened(CommandMeter(program(text), CLOCK)) as meter:
        assert [meter.read(0.2) for _ in range(5)] == [None] * 5


def test_what_it_prints_to_standard_error_is_no_level_and_is_shown_when_it_ends():
    text = "import sys, time\nfor _ in range(20):\n print('42 lost blocks', file=sys.stderr)\n print(-41.5)\n"
    text += " time.sleep(0.03)\nprint('No supported devices found.', file=sys.stderr)\nraise SystemExit(1)"
    with opened(CommandMeter(program(text), CLOCK)) as meter:
        assert {level(meter).value for _ in range(10)} == {-41.5}
    assert end_of(CommandMeter(program(text), CLOCK)).endswith("exit status 1: No supported devices found.")


def test_lines_are_cut_the_same_however_they_arrive():
    printed = b"-41.5\n" + b"9" * 9000 + b"\n-40.5\n\xff\x1b[2J\n3"
    for size in (1, 7, 4096, 20_000):
        splitter = OutputLines()
        lines = [line for at in range(0, len(printed), size) for line in splitter.lines(printed[at : at + size])]
        assert lines == ["-41.5", "-40.5", "\N{REPLACEMENT CHARACTER}[2J"], size
        assert list(splitter.rest()) == ["3"]


def test_lines_without_a_level_between_levels_are_no_reason_to_end_it():
    text = "import time\nwhile True:\n print('warming up')\n print(-41.5)\n time.sleep(0.1)"
    with opened(CommandMeter(program(text), CLOCK, patience_s=0.3)) as meter:
        assert {level(meter).value for _ in range(8)} == {-41.5}


def test_a_command_that_hangs_is_ended_with_what_it_started():
    text = "import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\nprint(1, flush=True)\ntime.sleep(60)"
    with opened(CommandMeter(program(text), CLOCK)) as meter:
        level(meter)
        child = meter._group.child
    assert child.poll() is not None


def test_the_powers_of_rtl_power_add_up():
    line = "2026-11-24, 12:00:00, 1420000000, 1420020000, 10000.00, 12, -50.00, -50.00"
    assert rtl_power_level(line) == pytest.approx(-46.99, abs=0.01)
    assert rtl_power_level("Number of frequency hops: 1") is None
    assert rtl_power_level(line + ", nan") == pytest.approx(-46.99, abs=0.01)
    assert [level_in(each) for each in ("", "x 1", "inf", "1e10", "2,5")] == [None, None, None, None, 2.0]


HOST = """
import sys, time
from birdcage.base.clock import RealClock
from birdcage.signal.command_meter import CommandMeter
meter = CommandMeter(sys.argv[1], RealClock())
meter.open()
print(meter._group.child.pid, flush=True)
time.sleep(60)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="its shell is no POSIX one")
def test_a_command_that_prints_nothing_ends_with_a_program_that_is_killed():
    mute = program("import time\ntime.sleep(60)")
    host = subprocess.Popen([sys.executable, "-c", HOST, mute], stdout=subprocess.PIPE)
    pid = int(host.stdout.readline())
    os.kill(pid, 0)
    host.kill()
    host.communicate()

    def is_gone():
        status = Path(f"/proc/{pid}/status")
        try:
            if Path("/proc/self").exists():
                return "State:\tZ" in status.read_text()
            os.kill(pid, 0)
        except (FileNotFoundError, ProcessLookupError):
            return True
        return False

    wait_until(is_gone)
