"""Every sentence that the command line prints is plain and whole: help of all commands, answers, refusals."""

from __future__ import annotations

import click
import pytest
from birdcage.base.paths import Paths
from birdcage.cli.app import cli

from tests.house.habits import habits_filled_in
from tests.house.sentences import Sentence, split

HERE = ("--lat", 51.5, "--lon", 0)
WITHOUT_A_DISH = (
    ("ports",), ("wiring",), ("wiring", "g2"), ("wiring", "adapters"), ("wiring", "nosuch"), ("paths",),
    ("config", "show"), ("config", "check"), ("config", "path"), ("setup", "--list"), ("log",), ("gear",),
    ("health", "--quick"), ("health", "--quick", "--acknowledge", "nosuch"),
    ("place",), ("place", "set", "nowhere at all"), ("place", "set", "JO21JV"), ("place",), ("place", "set", "99 999"),
    ("clock",), ("elements",), ("elements", "list"), ("elements", "add", "/no/such/file"), ("elements", "check"),
    ("where", "moon"), ("sky",), ("sky", *HERE),
    *(("where", each, *HERE) for each in ("moon", "nosuch", "28.2E", "iss", "ao-7", "119", "noaa")),
    ("passes", "iss", *HERE), ("passes", "nosuch", *HERE), ("passes", *HERE, "--hours", 0), ("passes", "--at", "never"),
    ("downlinks",), ("downlinks", "iss"), ("downlinks", "nosuch"), ("if", "12.5e9"), ("if", "abc"), ("if", "1"),
    ("craft", "up"), ("craft", "search", "moon"), ("hold",), ("release",), ("calibrate", "list"), ("nosuch",),
    ("maps",), ("export", "7"), ("export", "nosuch"), ("export", "1", "--as", "jpeg"),
    ("move",), ("move", "--az", "nan", "--el", 45), ("move", "--az", 10), ("track", "nosuch", "--plan"),
    ("track", "iss", "--plan", *HERE), ("autotrack", "--plan"), ("pos", "--firmware", "nosuch"),
    ("pos", "--baud", "fast"), ("--config", "no.toml", "pos"), ("sim", "--speed", 0), ("sim", "nosuch"),
)  # fmt: skip
OF_A_DISH = (
    ("pos",), ("status",), ("health",), ("detect",), ("init",), ("ready",), ("move", "--az", 10, "--el", 80),
    ("move", "--az", 10, "--el", 5), ("move", "--az", 5, "--el", 45), ("stop",), ("home",), ("calibrate", "next"),
    ("track", "iss", "--plan"), ("track", "moon"), ("autotrack", "--plan"), ("motors",),
    ("nvs", "get", 7, 20, 38, 83, 101, 113, 128),
    ("nvs", "set", 101, 17), ("nvs", "set", 101, 99), ("nvs", "set", 20, 5), ("nvs", "set", 83, 1, "--yes"),
    ("nvs", "save", "--yes"), ("nvs", "restore", "/no/such/file"),
)  # fmt: skip
PORTS = ("sim:g2", "sim:g2?unhomed=1", "/dev/no-such-port", "sim:nosuch", "")


def wrong_in(text: str, where: str) -> list[str]:
    """Return what is wrong with the sentences of a text."""
    return [
        f"{where}: {', '.join(found)}: {part}"
        for part in split(text)
        if (found := habits_filled_in(Sentence(part, where)))
    ]


def all_commands(command: click.Command = cli, words: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """Return the words of every command and group."""
    found = [words]
    if isinstance(command, click.Group):
        context = click.Context(command)
        for name in command.list_commands(context):
            below = command.get_command(context, name)
            assert below is not None
            found += all_commands(below, (*words, name))
    return found


def check(run, *commands: tuple[object, ...], **more: str) -> None:
    wrong = []
    for words in commands:
        result = run(*words, **more)
        where = " ".join(map(str, ("birdcage", *words, *more.values())))
        assert result.exception is None or isinstance(result.exception, SystemExit), where
        wrong += wrong_in(result.stdout, where) + wrong_in(result.stderr, where)
    assert not wrong, "\n".join(wrong)


def test_help_of_every_command(run) -> None:
    check(run, *((*words, "--help") for words in all_commands()))


def test_what_needs_no_dish(run) -> None:
    check(run, *WITHOUT_A_DISH, port="")


@pytest.mark.parametrize("port", PORTS)
def test_what_asks_a_dish(run, port) -> None:
    check(run, *OF_A_DISH, port=port)


def test_with_a_damaged_file_of_settings(run) -> None:
    file = Paths.default().config_file
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text('[place]\nlatitude_deg = "north"\n[motion]\nmin_elevaton_deg = 30\n[feed.x]\nbeam_deg = -1\n')
    check(
        run, ("config", "check"), ("config", "show"), ("pos",), ("move", "--az", 10, "--el", 40), ("place",), ("ready",)
    )
