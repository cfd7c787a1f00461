"""What docstrings and comments cite can be opened: a page of docs/ and a heading in it, a decision, a paper."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from functools import cache
from pathlib import Path

import pytest

from tests.house.pages import PAGES, ROOT, text_of

HERE = "tests/house/test_citations.py"
SOURCES = tuple(
    path.relative_to(ROOT).as_posix()
    for folder in ("driver/src", "tui/src", "tests", "scripts")
    for path in sorted((ROOT / folder).rglob("*.py"))
    if path.relative_to(ROOT).as_posix() != HERE  # names what it looks for
)

ELSEWHERE = re.compile(
    r"\b(?:source )?documents? 0\d\d\b|\bSEAMS\b|\bDESIGN\b|\btui-anchors\b|winegard-consoles|`tracking\.md`"
    r"|\b[Uu]nknowns? \d|\[(?:V|P|I|B|S\d|open)\]"
)
"""Documents that a reader of the repository has not, and the letters that they tag their facts with."""
SECTION = re.compile(r"\b[Ss]ections? \d(?:[\d.]*\d)?")
PAPER = re.compile(r"\b(?:CCSDS|NGA\.STND|Montenbruck|Meeus|Vallado|SP-1200|RFC \d|WCAG|ITU-R|ECMA-\d)")
"""A section with a number is one of these."""
PAGE = re.compile(r"(?<![\w/])docs/[\w./-]*\w")
NAMED = re.compile(r"`?(docs/[\w./-]*\.md)`?((?:(?:,| and) \*[^*]+\*)+)")
"""A page and the headings that are cited of it: `docs/safety.md, *Stop* and *Feed*`."""


def notes(source: str) -> list[tuple[int, str]]:
    """Return docstrings and comments, each in one line; comments that follow each other are one."""
    found = [
        (node.lineno, node.value.value)
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
    ]
    row, comment, began = -1, "", 0
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type != tokenize.COMMENT:
            continue
        if token.start[0] == row + 1 and token.line.lstrip().startswith("#"):
            found.pop()
            comment = f"{comment} {token.string.lstrip('#: ')}"
        else:
            comment, began = token.string.lstrip("#: "), token.start[0]
        row = token.start[0]
        found.append((began, comment))
    return [(line, " ".join(text.split())) for line, text in found]


def elsewhere(note: str) -> list[str]:
    """Return what a note cites that is not in the repository."""
    found = [match.group() for match in ELSEWHERE.finditer(note)]
    return found + [match.group() for match in SECTION.finditer(note) if not PAPER.search(note[: match.start()])]


@cache
def headings(page: str) -> tuple[str, ...]:
    """Return the headings of a page, as they are written."""
    prose = re.sub(r"^```.*?^```$", "", text_of(page), flags=re.DOTALL | re.MULTILINE)
    return tuple(re.findall(r"^#+ +(.+?) *$", prose, flags=re.MULTILINE))


def dead(note: str) -> list[str]:
    """Return the pages and headings that a note cites and that do not exist. A decision may be cited by its number."""
    pages = [page for page in PAGE.findall(note) if not list(ROOT.glob(f"{page}*"))]
    for page, names in NAMED.findall(note):
        known = headings(page) if page in PAGES else ()
        pages += [f"{page}, *{name}*" for name in re.findall(r"\*([^*]+)\*", names) if name not in known]
    return pages


@cache
def all_notes(source: str) -> list[tuple[int, str]]:
    return notes((ROOT / source).read_text(encoding="utf-8"))


def test_nothing_cites_a_document_that_is_not_here() -> None:
    offenders = [
        f"{source}:{line}: {', '.join(cited)}"
        for source in SOURCES
        for line, note in all_notes(source)
        if (cited := elsewhere(note))
    ]
    assert offenders == []


def test_every_page_and_heading_that_is_cited_exists() -> None:
    offenders = [
        f"{source}:{line}: {', '.join(cited)}"
        for source in SOURCES
        for line, note in all_notes(source)
        if (cited := dead(note))
    ]
    assert offenders == []


@pytest.mark.parametrize(("note", "found"), [
    ("Read both axes (section 7.4).", ["section 7.4"]),
    ("(reference sections 7.3 and 7.4, source document 001)", ["source document 001", "sections 7.3"]),
    ("As CCSDS 502.0-B section 7.5 writes them.", []), ("The budget (SEAMS *Figures*)", ["SEAMS"]),
    ("It may sink. [I]", ["[I]"]), ("An index: rows[I]", ["[I]"]), ("It may sink (assumed).", []),
])  # fmt: skip
def test_what_is_not_here_is_seen(note: str, found: list[str]) -> None:
    assert elsewhere(note) == found


@pytest.mark.parametrize(("note", "found"), [
    ("(docs/reference/g2.md, *Hazards*)", []), ("`docs/reference/g2.md`, *Menus* and *Hazards*", []),
    ("(docs/reference/g2.md, *Dangers*)", ["docs/reference/g2.md, *Dangers*"]), ("See docs/decisions/0003.", []),
    ("docs/reference/g2.md, *Menus* and *Moods*", ["docs/reference/g2.md, *Moods*"]),
    ("See docs/refrence/g2.md.", ["docs/refrence/g2.md"]), ("as docs/decisions/9999 has it", ["docs/decisions/9999"]),
])  # fmt: skip
def test_what_does_not_exist_is_seen(note: str, found: list[str]) -> None:
    assert dead(note) == found


def test_comments_in_a_row_are_one_note() -> None:
    source = "# The page is docs/safety.md,\n# *Feed*.\nx = 1  # one\n\n# two\n"
    assert [note for _, note in notes(source)] == ["The page is docs/safety.md, *Feed*.", "one", "two"]


def test_the_listing_sees_the_rooms() -> None:
    assert {Path(source).parts[0] for source in SOURCES} == {"driver", "tui", "tests", "scripts"}
    assert len(PAGES) > 40
