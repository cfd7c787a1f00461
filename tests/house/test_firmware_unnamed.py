"""From `antenna` up nothing names a firmware, or matches a firmware's words (`docs/developing.md`)."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.protocol.registry import FIRMWARE_REGISTRY
from birdcage.rotator import machines

ROOT = Path(__file__).parents[2]
ROOMS = (
    "antenna", "station", "tracking", "signal", "pursuit", "calibration", "diagnostics", "ready", "setup", "testing",
    "cli",
)  # fmt: skip
FOLDERS = [*(ROOT / "driver/src/birdcage" / room for room in ROOMS), ROOT / "tui/src/birdcage_tui"]
SOURCES = sorted(path for folder in FOLDERS for path in folder.rglob("*.py"))

MAY_NAME = {
    "driver/src/birdcage/cli/commands/sim.py", "driver/src/birdcage/cli/commands/serve.py",
    "driver/src/birdcage/cli/serve_serial.py", "tui/src/birdcage_tui/control/clients.py",
}  # fmt: skip
"""They name what they simulate, the language in which they serve others, and Hamlib's own client."""
DEFAULT = re.compile(r'^(?:DEFAULT|DEMO)_FIRMWARE = "\w+"$', re.MULTILINE)
"""What is tried first, and what the demo is."""

READERS = {"startswith", "endswith", "find", "rfind", "index", "count", "partition", "rpartition", "removeprefix"}
VALUES = {"homed", "position"}
"""Words that dialects print, and that the seam has as values of its own (`Verdict.forgets`)."""
PATTERNS = {"compile", "search", "match", "fullmatch", "findall", "finditer", "split", "sub"}


@dataclass(frozen=True)
class Words:
    """What dialects are called and what they print."""

    names: frozenset[str]
    """Of machines: in no case of letters."""
    printed: frozenset[str]
    """Prompts, marks, settings: as they are."""
    told: frozenset[str]
    """The words of what tells a refusal or a motor in trouble: common ones too, so only where text is matched."""

    def named_in(self, text: str) -> set[str]:
        """Return which names, and what of the printed words, a source holds."""
        text = DEFAULT.sub("", text)
        names = {name for name in self.names if re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text, re.IGNORECASE)}
        return names | {word for word in self.printed if word in text}

    def matched_in(self, text: str) -> set[str]:
        """Return which text a source looks for that holds a word by which a dialect tells something."""
        return {
            sought for sought in sought_in(text) if self.told & set(re.findall(r"[a-z]{3,}", literal(sought).lower()))
        }


def literal(pattern: str) -> str:
    """Return a pattern without what is no letter of a text."""
    return re.sub(r"\\.|\(\?P<\w+>|\(\?[a-z:=!<]+", " ", pattern)


def words_of(dialects: dict[str, type[FirmwareProtocol]]) -> Words:
    """Collect them from the dialects themselves."""
    names, printed, told = set(dialects), set[str](), set[str]()
    for each in dialects.values():
        facts, dialect = each.model, each.dialect
        names.add(facts.name)
        settings = [*facts.floor_settings, *facts.ceiling_settings]
        settings += [facts.search_setting] if facts.search_setting is not None else []
        printed |= {token for token in dialect.prompts.values() if token}
        printed |= {*each.boot_marks, *each.log_marks, *dialect.own_marks, facts.type_field}
        printed |= {text for setting in settings for text in (setting.id, setting.label)}
        for pattern, _ in (*dialect.refusals, *dialect.troubles):
            told |= set(re.findall(r"[a-z]{3,}", literal(pattern.pattern).lower()))
    return Words(frozenset(names | set(machines.names())), frozenset(printed - {""}), frozenset(told - VALUES))


def sought_in(text: str) -> Iterator[str]:
    """Yield the constants by which a source finds something in a text: `"x" in line`, `line.find("x")`, patterns."""
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Compare(
                ast.Constant(str(sought)), [ast.In() | ast.NotIn()], [ast.Name() | ast.Attribute() | ast.Call()]
            ):
                yield sought
            case ast.Compare(_, [ast.Eq() | ast.NotEq()], [ast.Constant(str(sought))]) if not sought.islower():
                yield sought
            case ast.Call(ast.Attribute(_, call), [ast.Constant(str(sought)), *_]) if call in READERS | PATTERNS:
                yield sought
            case ast.MatchValue(ast.Constant(str(sought))) if not sought.islower():
                yield sought


WORDS = words_of(FIRMWARE_REGISTRY)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_room_from_antenna_up_names_a_firmware_or_matches_its_words(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    if str(path.relative_to(ROOT)) not in MAY_NAME:
        assert WORDS.named_in(text) == set()
    assert WORDS.matched_in(text) == set()


@pytest.mark.parametrize(
    "planted",
    [
        'if facts.firmware == "g2":', "# as a HAL205 does", '"""Only of a Trav\'ler."""', 'LIMITS = {"hal205": 3}',
        'at = "MOT>"', 'state.readings.get("nvs.20")', '"NVS 101 is low"', '"Ant ID - " in line', '"Antenna ID"',
    ],
)  # fmt: skip
def test_a_planted_name_is_found(planted: str) -> None:
    assert WORDS.named_in(f"VALUE = 1\n{planted}\n")


@pytest.mark.parametrize(
    "planted",
    [
        '"STALLED" in said', 'said.startswith("Home Failure")', 're.compile(r"\\bout of range\\b")',
        'line == "Unknown Command"',
    ],
)  # fmt: skip
def test_a_planted_match_is_found(planted: str) -> None:
    assert WORDS.matched_in(f"VALUE = {planted}\n")


def test_the_defaults_may_be_named_and_ordinary_words_are_none() -> None:
    assert WORDS.named_in('DEMO_FIRMWARE = "g2"\nDEFAULT_FIRMWARE = "hal205"\n') == set()
    assert (
        WORDS.matched_in('if error.reason == "failed" or name in ("motor", "error"):\n    say("out of range")\n')
        == set()
    )
    assert len(SOURCES) > 400
