"""What a second move does to a machine is asked in one place above the seam: the choice of its strategy."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = [
    path.relative_to(ROOT)
    for folder in ("driver/src/birdcage", "tui/src/birdcage_tui")
    for path in sorted((ROOT / folder).rglob("*.py"))
    if not {"rotator", "protocol", "easycomm", "hamlib", "sim"} & set(path.relative_to(ROOT / folder).parts[:1])
]
KINDS = re.compile(r"\b(SecondMove|second_same|second_other)\b")
ASKS = {
    "driver/src/birdcage/antenna/strategy/choice.py": "the one place",
    "driver/src/birdcage/antenna/strategy/queue.py": "the strategy of those that wait",
    "driver/src/birdcage/base/config/fact_sections.py": "an owner's settings",
    "driver/src/birdcage/station/facts_file.py": "keeps them in a file",
    "driver/src/birdcage/station/facts_taken_over.py": "reads older files",
    "driver/src/birdcage/station/facts_memory.py": "names the settings in a warning",
    "driver/src/birdcage/cli/commands/sim.py": "an option of the simulator",
}


@pytest.mark.parametrize("path", [path for path in SOURCES if str(path) not in ASKS], ids=str)
def test_nothing_else_asks(path):
    text = (ROOT / path).read_text(encoding="utf-8")
    assert not KINDS.findall(text)


def test_each_exception_is_one():
    for path in ASKS:
        assert KINDS.search((ROOT / path).read_text(encoding="utf-8")), path
