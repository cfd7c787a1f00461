"""Entry points are found as the standard library finds them, and what is no such file is passed over."""

from __future__ import annotations

import sys
from importlib.metadata import entry_points as standard

import pytest
from birdcage.base.entry_points import entry_points, load


@pytest.mark.parametrize("group", ["birdcage.dialects", "birdcage.link", "console_scripts", "pytest11"])
def test_it_finds_what_the_standard_library_finds(group):
    assert entry_points(group).items() >= {(each.name, each.value) for each in standard(group=group)}


def test_a_package_further_up_the_path_counts_and_damaged_files_do_not(tmp_path, monkeypatch):
    for folder, text in (
        ("one", b"[birdcage.x]\nname = os:path [extra]\n# no = thing\n[other]\nelse = os\n"),
        ("two", b"[birdcage.x]\nname = sys:path\nmore = sys:argv\n"),
        ("bad", b"[birdcage.x]\n\xff = y:z\n"),
    ):
        home = tmp_path / folder / f"{folder}.dist-info"
        home.mkdir(parents=True)
        home.joinpath("entry_points.txt").write_bytes(text)
    monkeypatch.setattr(sys, "path", [str(tmp_path / name) for name in ("bad", "missing", "one", "two")])
    assert entry_points("birdcage.x") == {"name": "os:path", "more": "sys:argv"}
    assert load("sys:argv") is sys.argv
