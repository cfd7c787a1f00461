"""The pages that people read: README, docs, the packages' own, and the command lines, links and scripts in them."""

from __future__ import annotations

import re
import shlex
import tomllib
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = tuple(
    path.relative_to(ROOT).as_posix()
    for path in (ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md", *sorted(ROOT.glob("*/README.md")),
                 *sorted((ROOT / "docs").rglob("*.md")))
)  # fmt: skip
_BLOCK = re.compile(r"^ *```(\w+)\n(.*?)^ *```$", flags=re.DOTALL | re.MULTILINE)
_LINK = re.compile(r"\]\(([^)\s]+)\)")


@cache
def text_of(page: str) -> str:
    """Return a page."""
    return (ROOT / page).read_text(encoding="utf-8")


def blocks(page: str, *languages: str) -> list[str]:
    """Return the code blocks of a page in these languages."""
    return [text for language, text in _BLOCK.findall(text_of(page)) if language in languages]


def command_lines(page: str) -> list[list[str]]:
    """Return what a person may type: each line of a `sh` block, and what follows `$ ` where a session is shown."""
    lines = [line for block in blocks(page, "sh") for line in block.splitlines() if line.strip()]
    lines += [line[2:] for block in blocks(page, "console") for line in block.splitlines() if line.startswith("$ ")]
    return [words for line in lines if (words := shlex.split(line, comments=True))]


def started_by(words: list[str]) -> list[str]:
    """Return the command that a line starts in the end: `uvx --from ./tui birdcage-tui` starts `birdcage-tui`."""
    if words[0] == "scripts/demo":
        return ["birdcage-tui", *words[1:]]
    if words[0] == "uvx":
        return words[3:] if words[1] == "--from" else words[1:]
    return words


def entry_points(distribution: str) -> dict[str, str]:
    """Return the commands that a package installs."""
    with (ROOT / distribution / "pyproject.toml").open("rb") as file:
        scripts: dict[str, str] = tomllib.load(file)["project"]["scripts"]
    return scripts


def links(page: str) -> list[str]:
    """Return where the links and pictures of a page lead to, code left out."""
    prose = re.sub(r"`[^`\n]*`", "", _BLOCK.sub("", text_of(page)))
    return _LINK.findall(prose)


@cache
def anchors(page: str) -> frozenset[str]:
    """Return the anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.+?) *$", _BLOCK.sub("", text_of(page)), flags=re.MULTILINE)
    plain = (re.sub(r"[^\w\- ]", "", heading.lower()) for heading in headings)
    return frozenset(heading.replace(" ", "-") for heading in plain)
