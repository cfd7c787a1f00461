"""A hostile name, put in at every entrance: the terminal is told nothing by it."""

from __future__ import annotations

import json
import sqlite3
import unicodedata
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.journal_schema import MIGRATIONS as JOURNAL
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue

EVIL = "EV\x1b]0;owned\x07\x1b[2J\x9b31mI\u202eL\u2066\u200f\x85X"
"""Sets the title, clears the screen, paints red by C1, turns the direction of writing round."""
SEEN = "]0;owned[2J31m"
LINE_1 = "1 25544U 98067A   {epoch}  .00001789  00000-0  34232-4 0  999"
LINE_2 = "2 {number}  51.6424 359.2893 0003646 356.2318 141.8186 15.54186379 9553"


def summed(line):
    return line + str(sum(int(each) if each.isdigit() else each == "-" for each in line) % 10)


def tle(number):
    epoch = f"{datetime.now(UTC) - timedelta(hours=2):%y%j}.50000000"
    return summed(LINE_1.format(epoch=epoch).replace("25544", str(number))), summed(LINE_2.format(number=number))


def omm(number):
    return {
        "OBJECT_NAME": EVIL, "OBJECT_ID": f"98{EVIL}", "NORAD_CAT_ID": number, "MEAN_MOTION": 15.54186379,
        "EPOCH": f"{datetime.now(UTC) - timedelta(hours=3):%Y-%m-%dT%H:%M:%S}", "ECCENTRICITY": 0.0003646,
        "INCLINATION": 51.6424, "RA_OF_ASC_NODE": 359.2893, "ARG_OF_PERICENTER": 356.2318, "MEAN_ANOMALY": 141.8186,
        "BSTAR": 3.4e-5,
    }  # fmt: skip


def files(number):
    """One name in every format that can hold it."""
    lines, fields = tle(number), omm(number + 1)
    kvn = "".join(f"{key} = {value}\n" for key, value in omm(number + 2).items())
    table = omm(number + 3)
    return {
        "a.tle": f"{EVIL}\n{lines[0]}\n{lines[1]}\n{EVIL}\n{lines[0][:40]}\n",
        "b.json": json.dumps([fields, {**fields, "EPOCH": EVIL}]),
        "c.kvn": f"CCSDS_OMM_VERS = 2.0\n{kvn}",
        "d.csv": ",".join(table) + "\n" + ",".join(map(str, table.values())) + "\n",
        f"{EVIL}.sat".replace(
            "/", ""
        ): f"[Satellite]\nNAME={EVIL}\nTLE1={lines[0]}\nTLE2={lines[1]}\n[{EVIL}]\nTLE1=x\n",
        "f.cat": f"{EVIL}\n25544\n{EVIL}\n",
    }


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path / "home"))
    (tmp_path / "home").mkdir()
    return Paths.in_folder(tmp_path / "home")


@pytest.fixture
def tell(run):
    """Run a command; return all that it printed, once nothing in that orders a terminal about."""

    def tell(*words, **more):
        result = run(*words, **more)
        assert result.exception is None or isinstance(result.exception, SystemExit), (words, result.exception)
        text = result.stdout + result.stderr
        bad = {f"{ord(each):#x}" for each in text if unicodedata.category(each) in ("Cc", "Cf", "Cs") and each != "\n"}
        assert not bad, (words, bad, text)
        return text

    return tell


def test_in_element_files_of_every_format(tell, tmp_path, home):
    folder = tmp_path / "files"
    folder.mkdir()
    for name, body in files(25544).items():
        (folder / name).write_text(body, encoding="utf-8")
    assert SEEN in tell("elements", "check", folder)
    assert "new" in tell("elements", "add", folder, "--group", EVIL)
    listed = tell("elements", "list", "--all")
    assert listed.count(SEEN) >= 4
    assert SEEN in tell("elements", "list")
    tell("elements", "favourite", "25544", "--tag", EVIL)
    for words in (
        ("list", EVIL), ("search", EVIL), ("search", "owned"), ("offset", EVIL, "1"), ("favourite",),
        ("add", f"/no/{EVIL}"), ("check", "-"), ("remove", EVIL, EVIL),
    ):  # fmt: skip
        tell("elements", *words, input=files(1)["a.tle"])
    passes = tell("passes", "--lat", "50", "--lon", "10", "--hours", "24", "--all")
    tell("passes", EVIL, "--lat", "50", "--lon", "10", "--json")
    assert passes


def test_in_a_catalogue_and_a_log_of_before(tell, home):
    Catalogue(home.catalogue).close()
    with sqlite3.connect(home.catalogue) as raw:
        raw.execute(
            "INSERT INTO satellite VALUES ('25544', ?, 25544, '2026-07-01T00:00:00+00:00', 51, 0, 0, 0, 0, 15, 0, 0, 0,"
            " '', 0, ?, '2026-07-01T00:00:00+00:00')",
            (EVIL, EVIL),
        )
        raw.execute("INSERT INTO membership VALUES ('25544', ?)", (EVIL,))
        raw.execute("PRAGMA user_version = 1")
    raw.close()
    assert SEEN in tell("elements", "list", "--all")
    home.state.mkdir(parents=True, exist_ok=True)
    raw = sqlite3.connect(home.journal)
    for statements in JOURNAL[:3]:
        for each in statements:
            raw.execute(each)
    raw.execute(
        "INSERT INTO pass (pursuit, name, kind, started, ended, outcome, controller, demo, site, time_offset_s)"
        " VALUES (1, ?, 'satellite', ?, ?, ?, 'fast', 0, ?, 0)",
        (EVIL, "2026-07-01T00:00:00.000Z", "2026-07-01T00:10:00.000Z", EVIL, EVIL),
    )
    raw.execute("INSERT INTO pass_remark VALUES (1, '2026-07-01T00:01:00.000Z', ?)", (EVIL,))
    raw.execute("PRAGMA user_version = 3")
    raw.commit()
    raw.close()
    assert SEEN in tell("log")
    tell("log", "1")


def test_in_settings_and_tables(tell, home):
    quoted = json.dumps(EVIL)
    home.config_file.write_text(
        f"[place]\nname = {quoted}\nlatitude_deg = 50\nlongitude_deg = 10\n{quoted} = 1\n"
        f"[motion]\nno_go_sectors = [[10, 20, 30, {quoted}]]\n[feed]\nactive = {quoted}\n[feed.{quoted}]\nx = 1\n"
        f"[{quoted}]\nx = 1\n[dish]\nfirmware = {quoted}\n",
        encoding="utf-8",
    )
    home.downlinks_file.write_text(
        f"[[downlink]]\nsatellite = {quoted}\nfreq_mhz = 137.5\nmode = {quoted}\nnote = {quoted}\n"
        f"[[downlink]]\n{quoted} = 1\n"
    )
    home.places_file.write_text(
        f"[[place]]\nname = {quoted}\nlatitude_deg = 1\nlongitude_deg = 2\n[[place]]\n{quoted} = 1\n"
    )
    for words in (
        ("config", "check"), ("config", "show"), ("place", "show"), ("place", "list"), ("ready",), ("downlinks",),
        ("passes", "--hours", "1"), ("where", "sun"),
    ):  # fmt: skip
        tell(*words)
    home.config_file.write_text(f"[place]\nname = {EVIL}\n", encoding="utf-8")
    tell("config", "check")


@pytest.mark.parametrize(
    "words",
    [
        (EVIL,), (f"--{EVIL}",), ("where", EVIL), ("track", EVIL), ("track", "--until", EVIL, "sun"),
        ("elements", EVIL),
        ("place", "add", "x", EVIL), ("place", "use", EVIL), ("place", "add", EVIL, "JO21jv"), ("move", "--az", EVIL),
        ("passes", "--min-elevation", EVIL), ("elements", "update", EVIL), ("--config", f"/no/{EVIL}", "paths"),
        ("place", "horizon", "import", EVIL), ("downlinks", EVIL), ("if", EVIL),
    ],
)  # fmt: skip
def test_on_the_command_line(tell, home, words):
    tell(*words)


def test_in_variables(tell, home, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_MIN_ELEVATION", EVIL)
    monkeypatch.setenv("BIRDCAGE_FIRMWARE", EVIL)
    for words in (("config", "check"), ("config", "show"), ("ready",)):
        tell(*words)
