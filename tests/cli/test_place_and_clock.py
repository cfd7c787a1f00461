"""`birdcage place` and `birdcage clock`: what is printed, what is kept, and what is refused."""

from __future__ import annotations

import json
import socket
import threading
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.gps import clock_check, system_time

HILL = ("place", "add", "Hill", "33.5S", "151.25E", "640")


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    return Paths.default()


@pytest.fixture
def gpsd():
    """A gpsd with one fix; its time is that of this machine."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        ahead = timedelta(0)

        def serve():
            while True:
                try:
                    connection, _ = server.accept()
                except OSError:
                    return
                with connection:
                    connection.recv(100)
                    now = (datetime.now(UTC) + serve.ahead).isoformat()
                    for each in (
                        {"class": "VERSION", "release": "3"},
                        {"class": "SKY", "uSat": 9, "hdop": 1.1},
                        {"class": "TPV", "mode": 3, "time": now, "lat": 51.9, "lon": 4.8, "altHAE": 44.04},
                    ):
                        connection.sendall(json.dumps(each).encode() + b"\n")
                    connection.recv(100)

        serve.ahead = ahead
        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        serve.url = f"gpsd://127.0.0.1:{server.getsockname()[1]}"
        yield serve
        server.shutdown(socket.SHUT_RDWR)
    thread.join(5)


def place(home):
    return load(home.config_file, {}).place


class TestPlace:
    def test_added_listed_used_and_removed(self, run, home):
        assert "no place is saved yet".casefold() in run("place", "list").stderr.casefold()
        home.config_file.write_text("# mine\n[place]\nlatitude_deg = 1.0  # roof\nlongitude_deg = 2.0\n")
        assert run(*HILL).exit_code == 0
        assert run("place", "add", "Town", "rotterdam").exit_code == 0
        result = run("place", "use", "hill")
        assert "The place before it was not saved: (no name)" in result.stderr
        assert place(home).latitude_deg == -33.5
        text = home.config_file.read_text()
        assert "# mine" in text
        assert "# roof" in text
        lines = run("place", "list").stdout.splitlines()
        assert lines[0].startswith("* Hill")
        assert "QF56pm  33.5000 S  151.2500 E   640 m  flat horizon" in lines[0]
        assert lines[1].startswith("  Town")
        assert [each["in_use"] for each in json.loads(run("place", "list", "--json").stdout)] == [True, False]
        assert run("place", "remove", "Town").exit_code == 0
        assert len(run("place", "list").stdout.splitlines()) == 1

    def test_the_first_one_is_told_how_to_make_it_count(self, run, home):
        assert "`birdcage place use 'My field'` makes it" in run("place", "add", "My field", "JO21jv").stderr
        run("place", "use", "My field")
        assert "No place is active" not in run("place", "add", "Other", "JO22jv").stderr

    def test_south_and_west_and_below_eye_level_may_be_a_minus(self, run, home):
        assert run("place", "add", "Roof", "-33.5", "-151.25", "--use").exit_code == 0
        assert "33.5000 S  151.2500 W" in run("place", "show").stdout
        assert run("place", "horizon", "add", "-40", "-1.5").exit_code == 0
        assert json.loads(run("place", "horizon", "show", "--json").stdout) == [[320.0, -1.5]]
        assert "No such option" in run("place", "add", "Town", "--ues", "rotterdam").stderr

    def test_shown(self, run, home):
        assert run("place", "show").exit_code == 2
        run(*HILL, "--use")
        values = json.loads(run("place", "show", "--json").stdout)
        assert (values["name"], values["height_m"], values["locator"]) == ("Hill", 640.0, "QF56pm")
        assert run("place", "show").stdout.startswith("Hill ")

    def test_what_is_in_use_can_be_saved(self, run, home):
        run("place", "add", "Roof", "--lat", "-1.5", "--lon", "-2.5", "--use")
        run("place", "horizon", "add", "90", "12")
        assert "flat horizon: a line needs a second point, not at 90°" in run("place", "show").stdout
        run("place", "add", "Copy")
        assert json.loads(run("place", "list", "--json").stdout)[1]["horizon"] == [[90.0, 12.0]]

    @pytest.mark.parametrize(
        ("words", "code", "says"),
        [
            (("add", "x", "springfield"), 2, "Which one"), (("add", "x"), 2, "No place is set"),
            (("add", "x", "JO21"), 2, "wide"), (("use", "y"), 2, 'Place "y" not found. Saved: none'),
            (("remove", "y"), 2, 'Place "y" not found'), (("add", "x", "1", "2", "--lat", "3"), 2, "not both"),
            (("add", " ", "1", "2"), 2, "a name has"), (("horizon", "import", "absent.txt"), 2, "can't be read"),
            (("gps", "/dev/no-such-receiver"), 3, "no-such-receiver"),
            (("gps", "gpsd://127.0.0.1:1"), 1, "No gpsd at 127.0.0.1:1"),
        ],
    )  # fmt: skip
    def test_refused_with_a_sentence(self, run, home, words, code, says):
        result = run("place", *words)
        assert (result.exit_code, says in result.stderr) == (code, True), result.stderr
        assert not home.places_file.exists()

    def test_a_name_twice(self, run, home):
        run(*HILL)
        result = run(*HILL)
        assert (result.exit_code, "already" in result.stderr) == (2, True)


class TestHorizon:
    def test_imported_shown_and_kept_with_the_saved_place(self, run, home, tmp_path):
        run(*HILL, "--use")
        (tmp_path / "trees.txt").write_text("# mine\n0 5\n90 12.5\n")
        assert (
            "Kept for Hill: horizon of 2 points, up to 12.5° at 90°."
            in run("place", "horizon", "import", tmp_path / "trees.txt").stderr
        )
        assert place(home).horizon == ((0.0, 5.0), (90.0, 12.5))
        shown = run("place", "horizon", "show").stdout
        (tmp_path / "again.txt").write_text(shown)
        run("place", "horizon", "clear")
        assert place(home).horizon == ()
        run("place", "horizon", "import", tmp_path / "again.txt")
        run("place", "add", "Other", "1", "2", "--use")
        assert place(home).horizon == ()
        run("place", "use", "Hill")
        assert place(home).horizon == ((0.0, 5.0), (90.0, 12.5))

    def test_a_wrong_line_is_named_and_nothing_is_kept(self, run, home, tmp_path):
        (tmp_path / "trees.txt").write_text("0 5\n90 120\n")
        result = run("place", "horizon", "import", tmp_path / "trees.txt")
        assert result.exit_code == 2
        assert "trees.txt:2: elevation 120" in result.stderr
        assert not home.config_file.exists()

    def test_recorded_where_the_dish_looks(self, run, home):
        home.config_file.write_text("[alignment]\naz_offset_deg = 30.0\n[place]\nhorizon = [[0, 5]]\n")
        at = json.loads(run("pos", "--json").stdout)
        assert run("place", "horizon", "record").exit_code == 0
        recorded = (pytest.approx(at["azimuth_deg"], abs=0.1), pytest.approx(at["elevation_deg"], abs=0.1))
        assert place(home).horizon == ((0.0, 5.0), recorded)

    def test_a_dish_that_does_not_know_where_it_is_records_nothing(self, run, home):
        result = run("place", "horizon", "record", port="sim:g2?unhomed=1")
        assert result.exit_code == 4
        assert not home.config_file.exists()


class TestGps:
    def test_printed_and_used(self, run, home, gpsd):
        home.config_file.write_text(f'[place]\ngps = "{gpsd.url}"\nhorizon = [[0, 5]]\nheight_m = 900.0\n')
        result = run("place", "gps")
        assert "JO21jv  51.9000 N    4.8000 E    44 m" in result.stdout
        assert "9 satellites, HDOP 1.1" in result.stderr
        assert "The clock is good by gpsd" in result.stderr
        assert place(home).latitude_deg is None
        run("place", "gps", "--use", "--name", "Field")
        here = place(home)
        assert (here.name, here.latitude_deg, here.height_m, here.horizon) == ("Field", 51.9, 44.0, ())

    def test_the_same_place_again_keeps_its_horizon(self, run, home, gpsd):
        run("place", "gps", gpsd.url, "--use", "--name", "Field")
        run("place", "horizon", "add", "10", "20")
        run("place", "gps", "--use")
        assert (place(home).name, place(home).horizon) == ("Field", ((10.0, 20.0),))

    def test_the_clock_by_gps(self, run, home, gpsd):
        values = json.loads(run("clock", "--gps", gpsd.url, "--json").stdout)
        assert (values["kind"], values["doubtful"]) == ("gps", False)
        assert abs(values["offset_s"]) < 1.0
        gpsd.ahead = timedelta(seconds=90)
        assert "slow by gpsd" in run("clock", "--gps", gpsd.url).stdout


class TestClock:
    def test_what_the_system_says(self, run, home, monkeypatch):
        monkeypatch.setattr(system_time.shutil, "which", lambda _name: None)
        result = run("clock")
        assert result.exit_code == 0
        assert "This system does not tell whether its clock is right" in result.stdout
        assert "One second costs 1° on the space station overhead (1°/s); the error of this clock is unknown." in (
            result.stdout
        )

    def test_by_a_watch_and_what_it_costs_on_a_pass(self, run, home):
        now = datetime.now(UTC)
        result = run("clock", "--utc", f"{now:%H:%M:%S}", "--rate", "0.5")
        assert "The clock is good by your watch" in result.stdout
        assert "One second costs 0.5° on that pass" in result.stdout
        assert (home.state / clock_check.FILE).exists()
        wrong = run("clock", "--utc", f"{now + timedelta(seconds=40):%H:%M:%S}", "--json")
        values = json.loads(wrong.stdout)
        assert values["doubtful"] is True
        assert values["offset_s"] == pytest.approx(-40.0, abs=2.5)
        assert not (home.state / clock_check.FILE).exists()

    @pytest.mark.parametrize("words", [("--utc", "25:00"), ("--utc", "soon"), ("--utc", "12:00", "--gps", "gpsd")])
    def test_a_wrong_command_line(self, run, home, words):
        assert run("clock", *words).exit_code == 2


def test_none_of_it_touches_the_network_or_writes_by_itself(run, home, monkeypatch):
    def refuse(*_words, **_more):
        raise AssertionError("a socket was opened")

    monkeypatch.setattr(socket.socket, "connect", refuse)
    for words in (("place", "list"), ("place", "show"), ("place", "horizon", "show"), ("clock",)):
        assert "a socket was opened" not in run(*words).output
    assert list(home.config_file.parent.rglob("*.toml")) == []
