"""Nothing of the sky asks for a network but what says so: sockets are forbidden, and every try is counted."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import click
import pytest
from birdcage.cli.app import COMMANDS, cli

TLE = """ISS (ZARYA)
1 25544U 98067A   26325.50000000  .00016717  00000-0  10270-3 0  9000
2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391    16
"""
ASKS = {"elements update", "craft search", "craft up", "craft passes"}
"""What is there to ask others."""
RECEIVER = {"place gps", "place horizon record"}
"""What is there to ask a receiver or the dish."""
OF_THE_SKY = ("place", "clock", "elements", "passes", "where", "sky", "downlinks", "if", "ready", "craft")

RUN = """
import json, sys

tries = []

def watch(event, given):
    if event == "socket.__new__" and str(given[1]) not in ("1", "AddressFamily.AF_UNIX"):
        tries.append(f"{event} {given[1]}")
    elif event.startswith("socket.") and event not in ("socket.__new__", "socket.gethostname"):
        tries.append(f"{event} {given[1:]}")
    elif event == "subprocess.Popen" and given[0].rpartition("/")[2] not in ("chronyc", "timedatectl"):
        tries.append(f"{event} {given[0]}")
    else:
        return
    raise OSError(101, "forbidden by a test")

sys.addaudithook(watch)

from birdcage.cli.app import cli
from click.testing import CliRunner

told = []
for words in json.loads(sys.argv[1]):
    before = len(tries)
    done = CliRunner().invoke(cli, words, prog_name="birdcage", input="")
    fault = None if done.exception is None or isinstance(done.exception, SystemExit) else repr(done.exception)
    told.append([words, done.exit_code, done.stdout, done.stderr, tries[before:], fault])

if len(sys.argv) > 2:
    from datetime import UTC, datetime
    from pathlib import Path
    from birdcage.base.clock import VirtualClock
    from birdcage.sky.observer import Observer
    from birdcage.sky.watch import SkyWatch

    before, published, clock = len(tries), [], VirtualClock(datetime(2026, 11, 21, 12, tzinfo=UTC))
    sky = SkyWatch(Path(sys.argv[2]), published.append, clock, observer=Observer(51.9, 4.8))
    for _ in range(3):
        while sky.step() <= clock.monotonic():
            pass
        clock.advance(30.0)
    found = len(published[-1].passes)
    sky.close()
    told.append([["SkyWatch"], 0 if found else 1, "", "", tries[before:], None])
print(json.dumps(told))
"""


@pytest.fixture
def offline(tmp_path):
    """Run commands in a process that has no sockets: words, exit code, stdout, stderr, tries and fault of each."""
    home = tmp_path / "home"
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("BIRDCAGE_", "XDG_"))}

    def offline(commands, *more, **env):
        done = subprocess.run(
            [sys.executable, "-c", RUN, json.dumps(commands), *map(str, more)],
            env={**clean, "BIRDCAGE_HOME": str(home), **env}, cwd=tmp_path, capture_output=True, text=True,
            timeout=100, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    offline.home = home
    return offline


def leaves(command: click.Command, name: str) -> set[str]:
    """Return the names of a command's subcommands, or its own."""
    if not isinstance(command, click.Group):
        return {name}
    return {leaf for sub, each in command.commands.items() for leaf in leaves(each, f"{name} {sub}")}


def test_everything_of_the_sky_works_without_a_network(offline, tmp_path):
    (tmp_path / "iss.tle").write_text(TLE)
    (tmp_path / "horizon.txt").write_text("0 5\n90 12\n")
    at = ("--start", "2026-11-21", "--hours", "24")
    commands = [
        ["sky"], ["passes"], ["where", "sun"], ["place", "show"], ["elements", "list"], ["ready"],  # all unset
        ["place", "add", "Field", "JO21jv", "--use"], ["place", "add", "Town", "rotterdam"],
        ["place", "list", "--json"],
        ["place", "use", "Town"], ["place", "show", "--json"], ["place", "horizon", "import", "horizon.txt"],
        ["place", "horizon", "add", "180", "8"], ["place", "horizon", "show", "--json"], ["place", "horizon", "clear"],
        ["place", "remove", "Field"], ["clock"], ["clock", "--utc", "12:00:00", "--json"],
        ["sky"], ["sky", "--json"], ["passes"], ["passes", "--json", "--limit", "3"], ["where", "iss"],  # frozen
        ["elements", "add", "iss.tle", "--group", "mine"], ["elements", "list", "--groups"],
        ["elements", "list", "--json"], ["elements", "list", "--all", "--json"], ["elements", "check", "--json"],
        ["elements", "check", "iss.tle"], ["elements", "search", "zar", "--json"],
        ["elements", "favourite", "25544", "--tag", "human", "--json"], ["elements", "offset", "25544", "2", "--json"],
        ["passes", *at, "--json"], ["passes", *at, "--ics", "out.ics", "--csv", "out.csv", "--freq", "145.8"],
        ["passes", *at, "--sort", "reach", "--firmware", "g2"], ["passes", *at, "--elements", "iss.tle", "--json"],
        ["sky", "--json", "--firmware", "g2"], ["where", "25544", "--json"], ["where", "moon", "--json"],
        ["where", "28.2E", "--json"], ["where", "ra=5h34m,dec=+22d", "--json"], ["where", "az", "180", "el", "45"],
        ["downlinks", "--json"], ["downlinks", "--all"], ["if", "--rf", "10489.5M", "--lo", "9.75G", "--json"],
        ["ready", "--json"], ["elements", "remove", "25544", "--json"],
    ]  # fmt: skip
    told = offline(commands, offline.home / "data" / "catalogue.sqlite")
    assert [(words, tries) for words, _, _, _, tries, _ in told if tries] == []
    assert [(words, fault) for words, *_, fault in told if fault] == []
    unset, rest = told[:6], told[6:]
    assert [code for _, code, *_ in unset] == [2, 2, 2, 2, 0, 1]
    failed = [(words, code, err) for words, code, _, err, *_ in rest if code and words[0] != "ready"]
    assert failed == []
    for words, _, out, *_ in told:
        if "--json" in words:
            json.loads(out)
    ran = {" ".join(words) for words, *_ in told}
    known = {leaf for name in OF_THE_SKY for leaf in leaves(cli.get_command(click.Context(cli), name), name)}
    assert set(OF_THE_SKY) < set(COMMANDS)
    assert [leaf for leaf in known - ASKS - RECEIVER if not any(each.startswith(leaf) for each in ran)] == []


def test_what_is_there_to_ask_others_would_have_been_counted(offline):
    told = offline(
        [["elements", "update", "stations"], ["craft", "up"], ["place", "gps", "gpsd"]],
        BIRDCAGE_CRAFT_URL="http://127.0.0.1:9",
    )
    for words, code, _, _, tries, fault in told:
        assert tries, words
        assert (code, fault) == (1, None), words


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
def test_a_terminal_without_these_letters_still_tells(encoding, tmp_path):
    env = {**os.environ, "BIRDCAGE_HOME": str(tmp_path), "PYTHONIOENCODING": encoding}
    place = ("--lat", "51.9", "--lon", "4.8")
    for words in (("sky", *place), ("passes", *place), ("where", "sun", *place), ("sky", "--json", *place)):
        done = subprocess.run(
            [sys.executable, "-c", "from birdcage.cli import main; main()", *words],
            env=env, capture_output=True, timeout=60, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr[-500:]
        if "--json" in words:
            assert any("°" in row["name"] for row in json.loads(done.stdout.decode(encoding)))
