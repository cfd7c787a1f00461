"""The entry point: what it refuses, and what happens to the dish when the app ends."""

import gc
import subprocess
import sys
from dataclasses import replace
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from types import SimpleNamespace

import pytest
import stand_in
from birdcage.base.paths import Paths
from birdcage.link.ports import PortInfo
from birdcage_tui import main, run
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp


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


class Ended:
    """An app that ends at once, in one way or another."""

    return_code, fault, crash = 0, None, None
    track = SimpleNamespace(wait=lambda _timeout_s: None)

    def __init__(self, session, _settings):
        self.dishes = SimpleNamespace(end=self.end, crash=session.crash)
        self.session = session
        self.ending = SimpleNamespace(anew=None, by_signal=lambda _number: None)

    def begin_with(self, number):
        assert number == 1

    def end(self, _by, wait_s):
        words = self.session.close()
        self.track.wait(wait_s)
        return words

    def run(self):
        if self.crash is not None:
            raise self.crash


@pytest.fixture
def session():
    clock = stand_in.VirtualClock()
    return stand_in.Session(stand_in.slewing(clock), clock)


@pytest.fixture
def run_app(monkeypatch, session):
    """Run an app that ends as told; return the exit status."""

    def run_app(**ending):
        monkeypatch.setattr(run, "BirdcageApp", type("App", (Ended,), ending))
        monkeypatch.setattr(run, "_build", lambda *_: (session, AppOptions(), None))
        return run.run(main.parser().parse_args(["--demo"]))

    return run_app


@pytest.mark.parametrize(
    ("ending", "status"),
    [
        ({}, 0), ({"return_code": 143}, 143), ({"return_code": 3}, 3),
        ({"return_code": None}, 70),  # Textual's own threads end it so
        ({"return_code": 1, "fault": RuntimeError("torn")}, 70),
        ({"return_code": 0, "fault": RuntimeError("torn")}, 70),
    ],
)  # fmt: skip
def test_an_end_by_error_says_so_in_the_exit_status(run_app, session, ending, status):
    assert run_app(**ending) == status
    assert session.closed == 1


def test_a_station_that_has_failed_is_told_and_in_the_exit_status(run_app, session, capsys):
    session.crash = RuntimeError("torn")
    assert run_app() == 70
    assert "RuntimeError: torn" in capsys.readouterr().err


def test_a_fault_while_the_app_begins_is_a_traceback_and_a_status_of_its_own(monkeypatch, capsys):
    monkeypatch.setattr(run, "run", lambda _options: 1 // 0)
    monkeypatch.setattr(main, "_options", lambda _arguments: None)
    assert main.main([]) == 70
    gc.unfreeze()
    gc.enable()
    assert "ZeroDivisionError" in capsys.readouterr().err


def test_a_last_line_that_nobody_takes_changes_no_status(run_app):
    with Path("/dev/full").open("w") as full, pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdout", full)
        assert run_app() == 0
        full.write("more")  # Python's last flush, which would make the status 120, now goes nowhere
        full.flush()


@pytest.mark.parametrize("crash", [None, RuntimeError("torn"), KeyboardInterrupt()])
def test_however_the_app_ends_the_session_is_closed(crash, run_app, session, monkeypatch, capsys):
    ends = []
    track = SimpleNamespace(wait=lambda timeout_s: ends.append((session.closed, timeout_s)))
    if crash is None:
        assert run_app(track=track) == 0
        assert capsys.readouterr().out == "The dish's position is not known.\n"
    else:
        with pytest.raises(type(crash)):
            run_app(track=track, crash=crash)
    assert session.closed == 1
    assert ends == [(1, run.LEAVE_S)], "what was followed is remembered once the dish was stopped, also by a crash"


def test_an_unknown_firmware_and_a_missing_file_are_one_sentence(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    assert run.run(main.parser().parse_args(["--port", "/dev/null", "--firmware", "nosuch"])) == 1
    assert "nosuch" in capsys.readouterr().err
    assert run.run(main.parser().parse_args(["--config", str(tmp_path / "none")])) == 1
    assert "is not a file" in capsys.readouterr().err


def test_the_only_adapter_is_taken_when_none_is_named(monkeypatch):
    one = PortInfo("/dev/ttyUSB7", None, "FTDI", "0403:6001", "A1", "1-1")
    monkeypatch.setattr(run, "list_ports", lambda: [one])
    assert run._only_port() == "/dev/ttyUSB7"
    monkeypatch.setattr(run, "list_ports", lambda: [one, replace(one, device="/dev/ttyUSB8")])
    assert run._only_port() == "", "which of two is not obvious: the setup asks"


ONE = PortInfo("/dev/ttyUSB7", None, "FTDI", "0403:6001", "A1", "1-1")


@pytest.mark.parametrize(
    ("plugged", "words", "file", "port", "page"),
    [
        ([], [], None, "", "setup"),
        ([ONE], [], None, "/dev/ttyUSB7", "setup"),
        ([], ["--port", "/dev/ttyUSB3"], None, "/dev/ttyUSB3", "setup"),
        ([], [], '[dish]\nport = "/dev/ttyUSB3"\nfirmware = "g2"\n', "/dev/ttyUSB3", "dashboard"),
        ([], [], '[dish]\nport = "/dev/ttyUSB3"\n', "/dev/ttyUSB3", "setup"),
        ([ONE], ["--firmware", "g2"], '[setup]\nlink = "skipped 2026-03-20T12:00Z"\n', "/dev/ttyUSB7", "dashboard"),
        ([], [], '[setup]\nlink = "skipped 2026-03-20T12:00Z"\n', "", "setup"),
        ([ONE], ["--demo"], None, run.demo_port("g2"), "dashboard"),
    ],
)
def test_the_setup_opens_by_itself_on_a_first_run_or_without_a_port(
    plugged, words, file, port, page, monkeypatch, tmp_path
):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    monkeypatch.setattr(run, "list_ports", lambda: plugged)
    options = main.parser().parse_args(words)
    paths = Paths.in_folder(tmp_path)
    if file is not None:
        paths.config_file.parent.mkdir(parents=True, exist_ok=True)
        paths.config_file.write_text(file)
    session, settings, _services = run._build(options, paths)
    try:
        assert settings.first_page == page
        assert session.station.state.port.partition("&id=")[0] == port
        assert (settings.place is not None) == settings.tour == options.demo
        assert settings.setup is not None
        setup = settings.setup()
        assert len(setup.steps()) == 11
        setup.tick()
        offered = any("ttyUSB7" in choice.label for choice in setup.step("link").choices)
        assert offered == (bool(plugged) and not options.demo), "one key must not lead the demo to a real port"
    finally:
        session.close()


@pytest.mark.parametrize(
    ("answers", "firmware", "page"),
    [("hal205", "hal205", "dashboard"), ("g2", "g2", "dashboard"), (None, "g2", "setup")],
)
def test_the_firmware_that_answers_is_spoken_and_a_mute_port_opens_the_setup(
    answers, firmware, page, monkeypatch, tmp_path
):
    asked = []

    def detect(port, baud):
        asked.append((port, baud))
        return answers

    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    monkeypatch.setattr(run, "_detect", detect)
    paths = Paths.in_folder(tmp_path)
    paths.config_file.parent.mkdir(parents=True, exist_ok=True)
    paths.config_file.write_text('[dish]\nport = "/dev/ttyUSB3"\n')
    session, settings, _services = run._build(main.parser().parse_args([]), paths)
    try:
        assert asked == [("/dev/ttyUSB3", None)]
        assert session.station.state.dish.firmware == firmware
        assert settings.first_page == page
    finally:
        session.close()


@pytest.mark.parametrize("words", [["--firmware", "hal205"], ["--demo", "--firmware", "hal205"], ["--demo"]])
def test_a_firmware_that_was_named_is_not_listened_for(words, monkeypatch, tmp_path):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    monkeypatch.setattr(run, "_detect", lambda *_: pytest.fail("nothing is to be asked"))
    session, *_ = run._build(main.parser().parse_args(words), Paths.in_folder(tmp_path))
    try:
        named = "hal205" in words
        assert session.station.state.dish.firmware == ("hal205" if named else "g2")
        assert session.station.state.port.startswith("sim:hal205?" if named and "--demo" in words else "sim:g2?") or (
            "--demo" not in words
        )
    finally:
        session.close()


def test_another_dish_chosen_in_the_setup_begins_the_app_anew_over_the_old_flags(monkeypatch, capsys):
    clock = stand_in.VirtualClock()
    built, sessions, pages = [], [], []

    class App(Ended):
        def __init__(self, session, settings):
            super().__init__(session, settings)
            self.ending.anew = 1 if len(built) == 1 else None
            pages.append(settings.first_page)

    def build(options, paths):
        paths.config_file.parent.mkdir(parents=True, exist_ok=True)
        paths.config_file.write_text('[dish]\nfirmware = "hal205"\n')  # as the setup keeps it
        built.append((options.firmware, options.baud))
        sessions.append(stand_in.Session(stand_in.at_rest(clock), clock))
        return sessions[-1], AppOptions(), None

    monkeypatch.setattr(run, "BirdcageApp", App)
    monkeypatch.setattr(run, "_build", build)
    assert run.run(main.parser().parse_args(["--demo", "--firmware", "g2", "--baud", "115200"])) == 0
    assert built == [("g2", 115200), ("hal205", None)]
    assert pages == ["dashboard", "setup"], "it goes on where the other dish was chosen"
    assert [session.closed for session in sessions] == [1, 1]
    assert capsys.readouterr().out.count("The dish's position is") == 1


def test_another_dish_chosen_in_the_setup_of_the_second_one_shows_that_and_keeps_the_flags_of_the_first(monkeypatch):
    clock, built, seen = stand_in.VirtualClock(), [], []

    class App(BirdcageApp):
        def run(self):
            seen.append((self.dishes.number, [dish.settings.first_page for dish in self.dishes.all]))
            if len(seen) == 1:
                self.take_next()
                self.begin_anew()
            else:
                self.leave()

    def build(options, paths, clock_given=None, number=1):
        second = paths.config_file.with_name("second.toml")
        second.parent.mkdir(parents=True, exist_ok=True)
        second.write_text('[dish]\nfirmware = "hal205"\n')  # as its setup keeps it
        built.append((number, options.firmware, options.baud))
        return stand_in.Session(stand_in.at_rest(clock), clock), AppOptions(), None

    monkeypatch.setattr(run, "BirdcageApp", App)
    monkeypatch.setattr(run, "_build", build)
    words = ["--demo", "--firmware", "g2", "--baud", "115200", "--also", "hal000"]
    assert run.run(main.parser().parse_args(words)) == 0
    first = (1, "g2", 115200)
    assert built == [first, (2, "hal000", None), first, (2, "hal205", None)]
    assert seen == [(1, ["dashboard", "dashboard"]), (2, ["dashboard", "setup"])]


def test_nothing_of_setup_catalogue_or_sky_is_loaded_to_build_the_app(tmp_path):
    late = (
        "birdcage.setup.engine", "birdcage_tui.feeds.sky_source", "birdcage_tui.feeds.sky_convert",
        "birdcage.sky.watch", "birdcage.sky.catalogue", "sqlite3", "importlib.metadata", "numpy", "sgp4",
    )  # fmt: skip
    code = (
        "import sys; from pathlib import Path; from birdcage.base.paths import Paths;"
        "from birdcage_tui import main, run;"
        f"run._build(main.parser().parse_args(['--demo']), Paths.in_folder(Path({str(tmp_path)!r})))[0].close();"
        f"print([name for name in {late!r} if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert (done.stdout.strip(), done.stderr) == ("[]", ""), "each of these holds the first frame up"


def test_the_documented_entry_is_the_one_of_the_command():
    [command] = (point for point in entry_points(group="console_scripts") if point.name == "birdcage-tui")
    documented = EntryPoint("birdcage-tui", "birdcage_tui.app:main", "console_scripts")
    assert documented.load() is command.load() is main.main
