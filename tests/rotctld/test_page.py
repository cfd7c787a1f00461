"""The page of the protocol names every command, with its letter, its keys and its own words."""

from __future__ import annotations

import re

import pytest
from birdcage.rotctld.rprt import Rprt
from birdcage.rotctld.table import COMMANDS

from tests.house.pages import text_of

from .scripted_rotor import ScriptedRotor, talk

PAGE = text_of("docs/reference/rotctld.md")
ROW = re.compile(r"^\| (.*?) ?\| `(\w+)` \|(.*?)\|(.*?)\|(.*)\|$", re.MULTILINE)
ROWS = {(letter, long): keys for letter, long, _, keys, _ in ROW.findall(PAGE)}
EXAMPLES = {"loc2lonlat": "JO62", "send_cmd": "AZ", "lonlat2loc": "13 52 6"}


def test_every_command_has_a_row_and_every_row_a_command():
    ours = {(f"`{row.short}`" if row.short else "", row.long) for row in COMMANDS if row.long}
    assert set(ROWS) == ours


@pytest.mark.parametrize("row", [row for row in COMMANDS if row.long], ids=lambda row: row.long)
def test_the_keys_of_a_reply_are_those_of_the_page(row):
    keys = [key.strip() for key in ROWS[f"`{row.short}`" if row.short else "", row.long].split(",") if key.strip()]
    if keys == ["see below"]:
        return
    arguments = EXAMPLES.get(row.long, " ".join("1" for _ in row.arguments))
    (reply,) = talk(f"+\\{row.long} {arguments}\n".encode(), ScriptedRotor())
    told = [line.partition(": ")[0] for line in reply.decode().splitlines()[1:-1] if ": " in line and "\t" not in line]
    assert told == keys or row.long == "dump_caps"


def test_every_code_stands_there():
    assert re.findall(r"^\| (-?\d+) \| (\w+) \|", PAGE, re.MULTILINE) == [(f"{code:d}", code.name) for code in Rprt]
