"""The entry point: what it refuses, and what happens to the dish when the app ends."""

import subprocess
import sys
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.errors import BirdcageError
from birdcage.link.ports import PortInfo
from birdcage_tui import main, run
from birdcage_tui.settings import AppSettings


def test_help_and_version_need_no_textual():
    code = (
        "import sys; from birdcage_tui.main import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "sys.exit(any(name.split('.')[0] in ('textual', 'rich', 'click') for name in sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for option in ("--demo", "--port", "--firmware", "--baud", "--speed", "--theme", "--skip-init", "--config"):
        assert option in done.stdout


def test_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main.main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith("birdcage-tui ")


@pytest.mark.parametrize("words", [["--speed", "5"], ["--demo", "--port", "x"], ["--theme", "pink"], ["--demo"]])
def test_wrong_use_is_refused_with_a_sentence(words, capsys):
    with pytest.raises(SystemExit) as ended:
        main.main(words)
    assert ended.value.code == 2
    assert capsys.readouterr().err.strip()


@pytest.mark.parametrize("crash", [None, RuntimeError("torn"), KeyboardInterrupt()])
def test_however_the_app_ends_the_session_is_closed(crash, monkeypatch, capsys):
    clock = stand_in.VirtualClock()
    session = stand_in.Session(stand_in.slewing(clock), clock)

    class App:
        return_code = 0

        def __init__(self, *_):
            pass

        def run(self):
            if crash is not None:
                raise crash

    monkeypatch.setattr(run, "BirdcageApp", App)
    monkeypatch.setattr(run, "_build", lambda *_: (session, AppSettings()))
    options = main.parser().parse_args(["--demo"])
    if crash is None:
        assert run.run(options) == 0
        assert capsys.readouterr().out == "Where the dish is, is not known.\n"
    else:
        with pytest.raises(type(crash)):
            run.run(options)
    assert session.closed == 1


def test_a_missing_port_and_an_unknown_firmware_are_one_sentence(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    monkeypatch.setattr(run, "list_ports", list)
    assert run.run(main.parser().parse_args([])) == 1
    assert "--port" in capsys.readouterr().err
    assert run.run(main.parser().parse_args(["--port", "/dev/null", "--firmware", "nosuch"])) == 1
    assert "nosuch" in capsys.readouterr().err
    assert run.run(main.parser().parse_args(["--config", str(tmp_path / "none")])) == 1
    assert "no file" in capsys.readouterr().err


def test_the_only_adapter_and_the_only_firmware_are_taken_when_none_is_named(monkeypatch):
    one = PortInfo("/dev/ttyUSB7", None, "FTDI", "0403:6001", "A1", "1-1")
    monkeypatch.setattr(run, "list_ports", lambda: [one])
    monkeypatch.setattr(run, "list_firmwares", lambda: ("g2",))
    assert run._only_port() == "/dev/ttyUSB7"
    assert run._firmware(None) == "g2"
    monkeypatch.setattr(run, "list_ports", lambda: [one, replace(one, device="/dev/ttyUSB8")])
    monkeypatch.setattr(run, "list_firmwares", lambda: ("g2", "hal205"))
    with pytest.raises(BirdcageError, match="ttyUSB7, /dev/ttyUSB8"):
        run._only_port()
    with pytest.raises(BirdcageError, match="one of g2, hal205"):
        run._firmware(None)
