"""The machine that docs/a-new-machine.md shows keeps the contract, as it stands there."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.rotator import machines
from birdcage.testing import Contract

PAGE = Path(__file__).parents[2] / "docs/a-new-machine.md"
CASES = (
    "test_it_is_found_by_its_name_and_tells_its_facts", "test_what_is_shown_is_what_the_mechanics_do",
    "test_it_goes_all_round_its_circle", "test_a_step_moves_one_axis_and_names_only_that",
    "test_every_rung_has_a_scene", "test_stop_in_motion_by_each_rung", "test_what_stop_has_latched_does_not_go_out",
    "test_held_until_a_person_releases_it", "test_stop_ends_a_pass", "test_each_fault_at_each_moment",
    "test_pulled_out_in_motion_and_put_back", "test_silent_in_motion", "test_its_features_are_well_formed",
    "test_what_is_read_has_its_unit_and_lies_in_its_range", "test_what_is_written_is_read_back",
)  # fmt: skip


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    """Install what the page has, by its entry point, and take it out again."""
    folder = tmp_path_factory.mktemp("page")
    whole = PAGE.read_text(encoding="utf-8").split("## A whole one")[1]
    package = folder / "page_panhead"
    package.mkdir()
    for name, text in zip(("rotator", "twin"), re.findall(r"```py\n(.*?)```", whole, re.DOTALL), strict=True):
        (package / f"{name}.py").write_text(text, encoding="utf-8")
    info = folder / "panhead-1.0.dist-info"
    info.mkdir()
    (info / "entry_points.txt").write_text("[birdcage.machines]\npanhead = page_panhead.rotator:PanHead\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        machines.look_anew()
        yield importlib.import_module("page_panhead.twin").BENCH
    machines.look_anew()


@pytest.mark.parametrize("case", CASES)
def test_it_keeps_the_contract(bench, case):
    getattr(Contract(), case)(bench)


def test_its_twin_hears_whole_lines_and_breaks_as_a_socket_does(bench):
    clock = VirtualClock()
    twin = bench.twin(clock)
    line = twin.dial(twin.address, 0)
    line.write(b"V")
    assert (twin.received(), line.pending()) == (0, False)
    line.write(b"?\r\nPAN 200\r\n")
    assert twin.received() == 2
    assert line.read() == b"", "an answer is on its way for a while"
    clock.advance(0.1)
    assert line.read() == b"V=13.8\r\nERR 2\r\n"
    twin.mute()
    line.write(b"V?\r\n")
    clock.advance(0.1)
    assert (line.pending(), twin.received()) == (False, 2)
    twin.unplug()
    assert line.pending()
    with pytest.raises(LinkError):
        line.read()
    with pytest.raises(LinkError):
        twin.dial(twin.address, 0)
    twin.plug()
    twin.unmute()
    again = twin.dial(twin.address, 0)
    again.write(b"HALT\r\n")
    clock.advance(0.1)
    assert again.read() == b"OK\r\n"
