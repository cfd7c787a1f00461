"""Step 4 of a machine that a person syncs: two lines to type, and nothing turns."""

from __future__ import annotations

import pytest
from birdcage.base.paths import Paths
from birdcage.setup.engine import Setup
from birdcage.station.known import SystemFacts
from birdcage.testing import MachineBench, Stage
from installed_toys import installed


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import starter_twin

        yield starter_twin


@pytest.fixture
def told(twins, tmp_path):
    """A setup over one that was just switched on, and what answers a step of it."""
    from birdcage.base.config import load

    with Stage(MachineBench("starter", twins.StarterTwin, stops=())) as stage:
        stage.until(lambda: stage.state.surveyed, 10.0, "it was met")
        paths = Paths.in_folder(tmp_path)
        setup = Setup(
            stage.session, load(paths.config_file, {}), paths, environ={}, ports=list, system=SystemFacts,
        )  # fmt: skip

        def answer(choice, **values):
            setup.choose("home", choice, values)
            for _ in range(100):
                stage.step(0.1)
                setup.tick()
                if not setup.busy:
                    break
            return setup.step("home")

        yield stage, setup, answer


def test_it_asks_for_the_direction_and_is_done_once_told(told):
    stage, setup, answer = told
    before = setup.step("home")
    assert before.mark.value == "todo"
    assert before.evidence == "not synced yet"
    assert "Nothing moves." in before.words[0]
    after = answer("sync", az_deg="200", el_deg="")
    assert (after.mark.value, after.evidence) == ("done", "synced, now at AZ 200.00 EL 30.00")
    assert stage.twin.sent_to == []


def test_the_other_steps_ask_for_a_sync_and_no_homing(told):
    _stage, setup, answer = told
    assert "Sync it first: step 4." in setup.step("direction").words
    assert "To point there, sync it (step 4) and set north (step 10)." in setup.step("first").words
    answer("sync", az_deg="200", el_deg="")
    assert "Sync it first: step 4." not in setup.step("direction").words


def test_what_it_believes_otherwise_takes_a_second_word(told):
    stage, _setup, answer = told
    asked = answer("sync", az_deg="200", el_deg="70")
    assert asked.mark.value == "failed"
    assert "It measures its elevation itself: 30.00°" in asked.evidence
    assert "sure" in [choice.name for choice in asked.choices]
    assert answer("sure").mark.value == "done"
    assert stage.state.position.az_deg == pytest.approx(200.0)
