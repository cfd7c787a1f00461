"""The README promises commands: each must exist, under the name and with the options given there."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sysconfig
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(?:sh|console|text)\n(.*?)^```$", README, flags=re.DOTALL | re.MULTILINE)
COMMANDS = [shlex.split(line, comments=True) for block in BLOCKS for line in block.splitlines() if line.strip()]


def started_by(words: list[str]) -> list[str]:
    """Return the command that a line starts in the end: `uvx --from ./tui birdcage-tui` starts `birdcage-tui`."""
    if words[0] == "scripts/demo":
        return ["birdcage-tui", *words[1:]]
    if words[0] == "uvx":
        return words[3:] if words[1] == "--from" else words[1:]
    return words


OUR_COMMANDS = [words for words in map(started_by, COMMANDS) if words[0].startswith("birdcage")]


def entry_points(distribution: str) -> dict[str, str]:
    with (ROOT / distribution / "pyproject.toml").open("rb") as file:
        return tomllib.load(file)["project"]["scripts"]


def help_of(words: list[str]) -> str:
    """Return the help of the (sub)command that a README line starts."""
    subcommand = [word for word in words[1:2] if words[0] == "birdcage" and not word.startswith("-")]
    script = Path(sysconfig.get_path("scripts")) / words[0]
    done = subprocess.run([script, *subcommand, "--help"], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, f"{words[0]} {subcommand} --help: {done.stderr}"
    return done.stdout


def test_the_two_commands_of_a_fresh_machine_come_first() -> None:
    assert [words[0] for words in COMMANDS[:2]] == ["scripts/demo", "scripts/test"]


@pytest.mark.parametrize("script", ["scripts/demo", "scripts/test", ".ci/run"])
def test_a_script_can_be_started(script: str) -> None:
    assert os.access(ROOT / script, os.X_OK)
    assert subprocess.run(["sh", "-n", script], cwd=ROOT, timeout=60, check=False).returncode == 0


def test_every_command_line_starts_something_that_exists() -> None:
    known = {"scripts/test", *entry_points("driver"), *entry_points("tui")}
    assert {words[0] for words in map(started_by, COMMANDS)} <= known
    for words in COMMANDS:
        if "--from" in words:
            assert (ROOT / words[words.index("--from") + 1] / "pyproject.toml").is_file()


@pytest.mark.parametrize("words", OUR_COMMANDS, ids=lambda words: " ".join(words))
def test_options_in_the_readme_are_in_the_help(words: list[str]) -> None:
    text = help_of(words)
    for option in (word.partition("=")[0] for word in words[1:] if re.match(r"--[a-z]", word)):
        assert option in text, f"{option} is not in the help"
