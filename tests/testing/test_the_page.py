"""The machines that docs/a-new-machine.md and docs/a-new-console.md show keep the contract, as they stand there."""

from __future__ import annotations

import importlib
import re
from dataclasses import dataclass
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.rotator import machines
from birdcage.testing import Contract

DOCS = Path(__file__).parents[2] / "docs"
CASES = (
    "test_it_is_found_by_its_name_and_tells_its_facts", "test_what_is_shown_is_what_the_mechanics_do",
    "test_it_goes_all_round_its_circle", "test_a_step_moves_one_axis_and_names_only_that",
    "test_every_rung_has_a_scene", "test_stop_in_motion_by_each_rung", "test_what_stop_has_latched_does_not_go_out",
    "test_held_until_a_person_releases_it", "test_stop_ends_a_pass", "test_each_fault_at_each_moment",
    "test_pulled_out_in_motion_and_put_back", "test_silent_in_motion", "test_its_features_are_well_formed",
    "test_what_is_read_has_its_unit_and_lies_in_its_range", "test_what_is_written_is_read_back",
    "test_a_line_and_its_answer_or_no_console_at_all",
    "test_a_line_that_moves_is_told_as_such_and_refused_while_held",
)  # fmt: skip


@dataclass(frozen=True)
class Shown:
    """A machine that a page shows whole: its class, then its twin."""

    page: str
    group: str
    machine: str
    kind: str


PANHEAD = Shown("a-new-machine.md", "birdcage.machines", "panhead", "PanHead")
SKYVANE = Shown("a-new-console.md", "birdcage.dialects", "skyvane", "Skyvane")


@pytest.fixture(scope="module", params=(PANHEAD, SKYVANE), ids=lambda shown: shown.machine)
def bench(request, tmp_path_factory):
    """Install what a page has, by its entry point, and take it out again."""
    shown, folder = request.param, tmp_path_factory.mktemp("page")
    whole = (DOCS / shown.page).read_text(encoding="utf-8").split("## A whole one")[1]
    package = folder / f"page_{shown.machine}"
    package.mkdir()
    for name, text in zip(("driver", "twin"), re.findall(r"```py\n(.*?)```", whole, re.DOTALL), strict=True):
        (package / f"{name}.py").write_text(text, encoding="utf-8")
    info = folder / f"{shown.machine}-1.0.dist-info"
    info.mkdir()
    entry_point = f"{shown.machine} = {package.name}.driver:{shown.kind}"
    (info / "entry_points.txt").write_text(f"[{shown.group}]\n{entry_point}\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        machines.look_anew()
        yield importlib.import_module(f"{package.name}.twin").BENCH
    machines.look_anew()


@pytest.mark.parametrize("case", CASES)
def test_it_keeps_the_contract(bench, case):
    getattr(Contract(), case)(bench)


@pytest.mark.parametrize("bench", [PANHEAD], indirect=True, ids=["panhead"])
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
