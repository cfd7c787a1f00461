"""The installed app in a real terminal: bytes of other encodings, signals, terminals that close, block or are none."""

from __future__ import annotations

import signal
import sys

import pytest

if sys.platform == "win32":
    pytest.skip("needs a pty", allow_module_level=True)

from pty_dish import PtyDish
from pty_terminal import PtyTerminal

PLACE = '[place]\nname = "Bench"\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n'
FAREWELL = "The dish was last seen at AZ"
RESTORED = b"\x1b[?1049l"


@pytest.fixture
def dish():
    dish = PtyDish("seed=1&az_speed=6")  # it still slews when a loaded machine gets round to it
    yield dish
    dish.close()


@pytest.fixture
def start(dish, tmp_path):
    """Start the app on that dish, with settings that know it; it is up when this returns, unless `up` is False."""
    started = []

    def start(*words, up=True, env=None, **more):
        (tmp_path / "birdcage.toml").write_text(f'[dish]\nport = "{dish.path}"\nfirmware = "g2"\n{PLACE}')
        env = {"BIRDCAGE_HOME": str(tmp_path), **(env or {})}
        app = PtyTerminal("birdcage-tui", *words, env=env, **more)
        started.append(app)
        if up:
            app.wait_for(b"IDLE")
        return app

    yield start
    for app in started:
        app.close()


@pytest.fixture
def slewing(start, dish):
    """The app, with its dish in the middle of a long way."""

    def slewing(**more):
        app = start(**more)
        send(app, dish, b"200 45")
        return app

    return slewing


def send(app, dish, where):
    """Send the dish somewhere by the go-to line."""
    shown, lines = len(app.output), len(dish.lines())
    app.press(b"g")
    app.wait_for(b"Enter goes there", shown)
    app.press(where + b"\r")
    # Both axes were sent, or the one that changes, once the position is asked for again.
    dish.wait_for(lambda truth: stops_since(dish, lines) and dish.lines()[-1] == "a" and truth.moving)


def stops_since(dish, lines):
    """Return what moved the dish since so many lines had passed."""
    return [line for line in dish.lines()[lines:] if line.startswith(("a ", "g "))]


HOSTILE = {
    "latin-1": b"\xe9",
    "x10-mouse": b"\x1b[M \xf0\x91",
    "x10-mouse-that-looks-like-utf-8": b"\x1b[M \xc3\xa9",
    "cut-utf-8": b"\xe2\x94",
    "kitty-alternates": b"\x1b[97:65;2:1u",
    "kitty-beyond-unicode": b"\x1b[99999999;1u",
    "every-byte": bytes(byte for byte in range(0x80, 0x100)),
}


def test_bytes_that_are_no_keys_end_nothing_and_lose_no_stop(slewing, dish):
    app = slewing()
    for name, data in HOSTILE.items():
        shown, lines = len(app.output), len(dish.lines())
        app.press(data + b" ")
        dish.wait_for(lambda _truth, lines=lines: stops_since(dish, lines))
        assert app.process.poll() is None, name
        app.wait_for(b"HELD", shown)
        shown = len(app.output)
        dish.wait_for(lambda truth: not truth.moving)
        app.press(b"\r")
        app.wait_for(b"IDLE", shown)
        send(app, dish, b"200 45" if dish.device.truth().az_deg < 90 else b"20 45")
    app.press(b"\x11")
    assert app.status() == 0


@pytest.mark.parametrize("name", ["SIGINT", "SIGQUIT"])
def test_a_signal_stops_the_dish_and_ends_with_its_status(slewing, dish, name):
    number = getattr(signal, name)
    app = slewing()
    lines = len(dish.lines())
    app.signal(number)
    assert app.status() == 128 + number
    assert stops_since(dish, lines)[0].startswith("a 0 ")
    dish.wait_for(lambda truth: not truth.moving)
    assert dish.device.truth().az_deg != pytest.approx(200, abs=5)
    assert FAREWELL in app.text
    assert RESTORED in app.output
    assert "Traceback" not in app.text
    assert app.attributes() == app.before


@pytest.mark.parametrize("ignored", [(), ("SIGHUP",)], ids=["told", "not-told"])
def test_a_closed_terminal_stops_the_dish_and_ends_the_app(slewing, dish, ignored):
    app = slewing(ignored=ignored)
    lines = len(dish.lines())
    app.hang_up()
    assert app.status() == 128 + signal.SIGHUP
    assert stops_since(dish, lines)[0].startswith("a 0 ")
    dish.wait_for(lambda truth: not truth.moving)
    assert not dish.is_held_open()


def test_a_terminal_that_takes_nothing_any_more_does_not_keep_the_app_alive(slewing, dish):
    app = slewing()
    lines = len(dish.lines())
    app.block()
    app.signal(signal.SIGTERM)
    assert app.status() == 128 + signal.SIGTERM
    assert stops_since(dish, lines)[0].startswith("a 0 ")
    dish.wait_for(lambda truth: not truth.moving)
    assert app.attributes() == app.before


def test_nothing_is_drawn_into_a_stderr_that_is_no_terminal(start, tmp_path):
    log = tmp_path / "stderr"
    with log.open("wb") as file:
        app = start(stderr=file)
        app.press(b"\x11")
        assert app.status() == 0
    assert log.read_bytes() == b""


@pytest.mark.parametrize("env", [{"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "C"}], ids=["io", "locale"])
def test_an_ascii_locale_is_drawn_in_ascii_and_survives_the_farewell(start, env):
    app = start(env=env)
    app.press(b"\x11")
    assert app.status() == 0
    end = app.output.index(RESTORED)
    assert "?" * 10 not in app.text[:end], "signs have likenesses in ASCII"
    assert app.output[:end].isascii()
    assert FAREWELL.encode() in app.output[end:]
    assert b"Traceback" not in app.output


MOMENTS = (
    "argparse", "birdcage_tui.run", "birdcage.station.build", "textual.app", "textual.css.parse",
    "birdcage_tui.shell.birdcage_app", "birdcage_tui.pages.dashboard", "birdcage.station.control_server",
    "birdcage_tui.drawing.terminal",
)  # fmt: skip
"""Modules whose import stands for a moment of the first second."""


@pytest.mark.parametrize("module", MOMENTS)
def test_ctrl_c_in_the_first_second_ends_it_without_a_traceback(start, at_import, module):
    app = start(up=False, env=at_import(module, "os.kill(os.getpid(), signal.SIGINT)"))
    assert app.status() == 130
    assert "Traceback" not in app.text
    assert "KeyboardInterrupt" not in app.text


def test_a_fault_in_the_input_thread_is_told_in_the_status(start, at_import):
    deed = "import birdcage_tui.drawing.terminal as it; it.TerminalDriver.run_input_thread = lambda _: 1 // 0"
    app = start(up=False, env=at_import("birdcage_tui.pages.dashboard", deed))
    assert app.status() == 70
    assert "ZeroDivisionError" in app.text
