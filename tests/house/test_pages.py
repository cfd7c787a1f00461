"""What the pages promise: links lead somewhere, command lines are understood, scripts run, keys are the app's own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from birdcage.cli.app import cli as birdcage
from birdcage_tui.main import parser as birdcage_tui

from tests.house.pages import (
    PAGES,
    ROOT,
    anchors,
    blocks,
    command_lines,
    entry_points,
    links,
    started_by,
)

COMMANDS = [(page, words) for page in PAGES for words in command_lines(page)]
OURS = [(page, started) for page, words in COMMANDS if (started := started_by(words))[0].startswith("birdcage")]
SCRIPTS = {script for page in PAGES for script in blocks(page, "python") if "/dev/" not in script}
"""Those without a dish; `tests/antenna/test_documented_examples.py` runs the others."""
LINKS = [(page, link) for page in PAGES for link in links(page) if "://" not in link]


@pytest.mark.parametrize(("page", "link"), LINKS)
def test_a_link_leads_somewhere(page: str, link: str) -> None:
    name, _, anchor = link.partition("#")
    target = (ROOT / page).parent / name if name else ROOT / page
    assert target.exists(), f"{page}: there is no {name}"
    if anchor:
        assert anchor in anchors(target.resolve().relative_to(ROOT).as_posix()), f"{page}: no heading for #{anchor}"


def test_every_page_of_docs_can_be_reached_from_the_readme() -> None:
    reached, left = set(), ["README.md"]
    while left:
        page = left.pop()
        reached.add(page)
        for link in links(page):
            name = link.partition("#")[0]
            target = os.path.relpath((ROOT / page).parent / name, ROOT) if name and "://" not in link else ""
            if target in PAGES and target not in reached:
                left.append(target)
    assert {page for page in PAGES if page.startswith("docs/") and "decisions" not in page} <= reached


def test_every_command_line_starts_something_that_exists() -> None:
    known = {"scripts/test", "scripts/demo", *entry_points("driver"), *entry_points("tui")}
    for page, words in COMMANDS:
        assert started_by(words)[0] in known, f"{page}: {' '.join(words)}"
        if "--from" in words:
            assert (ROOT / words[words.index("--from") + 1] / "pyproject.toml").is_file(), page


@pytest.mark.parametrize(
    ("page", "words"), OURS, ids=lambda value: value if isinstance(value, str) else " ".join(value)
)
def test_a_command_line_is_understood(page: str, words: list[str], tmp_path: Path, monkeypatch) -> None:
    """Its commands, options and values are taken as they stand; nothing is run."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "iss.tle").touch()
    if words[0] == "birdcage-tui":
        birdcage_tui().parse_args(words[1:])
        return
    command, rest, context = birdcage, words[1:], None
    while True:
        context = click.Context(command, parent=context, info_name=words[0])
        try:
            command.parse_args(context, list(rest))
        except click.exceptions.Exit:
            return  # `--help`, `--version`
        if not isinstance(command, click.Group) or not (asked := [*context._protected_args, *context.args]):
            return
        inner = command.get_command(context, asked[0])
        assert inner is not None, f"{page}: there is no {asked[0]} in {' '.join(words)}"
        command, rest = inner, asked[1:]


@pytest.mark.parametrize("script", sorted(SCRIPTS))
def test_a_script_runs_as_it_stands(script: str, tmp_path: Path) -> None:
    home = {"HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path), "PATH": os.environ["PATH"]}
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False,
                          cwd=tmp_path, env=home)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert ("listening on port" if "RotctldServer" in script else "azimuth=20.0") in done.stdout


def test_the_tables_of_keys_are_the_apps_own() -> None:
    """`scripts/key_tables.py` writes them."""
    check = [sys.executable, "scripts/key_tables.py", "--check"]
    done = subprocess.run(check, capture_output=True, text=True, cwd=ROOT, timeout=60, check=False)
    assert done.returncode == 0, done.stderr


def test_the_page_of_events_is_what_events_and_requests_are() -> None:
    """`scripts/event_tables.py` writes it."""
    check = [sys.executable, "scripts/event_tables.py", "--check"]
    done = subprocess.run(check, capture_output=True, text=True, cwd=ROOT, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
