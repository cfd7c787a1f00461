"""The setup in an app that is attached: port and firmware are the business of the program that has the port."""

from __future__ import annotations

import pytest
from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.setup.engine import Setup
from birdcage.setup.steps.firmware import OTHER
from birdcage.station.known import SystemFacts
from birdcage.station.session import Session

VIA = "birdcage station run (process 4711)"


class ThroughAnother(Session):
    """As the session of an attached app looks to the setup."""

    via = VIA


def attached(house):
    session = ThroughAnother(house.clock, house.station)
    house.setup = Setup(session, house.setup.settings, house.paths, environ={}, ports=lambda: house.plugged,
                        system=SystemFacts)  # fmt: skip
    return house.setup


def test_the_step_of_the_port_says_who_has_it_and_offers_no_other(house):
    setup = attached(house)
    house.run(6.0)
    link = setup.step("link")
    assert link.words == (f"A dish answers on ttyUSB0, through {VIA}.",)
    assert [choice.name for choice in link.choices] == ["keep"]
    setup.choose("link", "keep")
    assert house.paths.config_file.read_text().count("ttyUSB0") >= 1


def test_without_an_answer_it_says_what_to_do(build):
    house = build()
    house.plugged, setup = [], attached(house)
    house.run(6.0)
    link = setup.step("link")
    assert link.words == (f"{VIA} has the port ttyUSB0. To use another one, end that program.",)
    assert link.choices == ()


def test_another_firmware_is_refused_with_the_way_out_and_nothing_is_written(build):
    house = build()
    house.plugged, setup = [], attached(house)
    house.run(6.0)
    others = [choice.name for choice in setup.step("dish").choices if choice.name.startswith(OTHER)]
    assert others
    with pytest.raises(BirdcageError, match="start it again with --firmware") as refused:
        setup.choose("dish", others[0])
    assert refused.value.reason is Reason.BUSY
    assert setup.begin_anew == ""
    assert not house.paths.config_file.exists()
