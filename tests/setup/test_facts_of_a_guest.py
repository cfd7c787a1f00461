"""What Setup says of a machine comes from its facts: one never heard of before is told like ours."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import pytest
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.facts import SearchSetting, SearchSwitch, Setting
from birdcage.rotator.wiring import Connector, Drawing
from birdcage.setup import wiring
from birdcage.setup.steps.dish import DishStep
from birdcage.setup.steps.home import HomeStep
from birdcage.setup.steps.limits import LimitsStep
from birdcage.setup.steps.link import LinkStep
from birdcage.setup.steps.search import SearchStep
from birdcage.station.state import Activity, LinkPhase, TvSearch

PLUG = Connector(
    "din", "Guest dish", "DIN, 5 pins", Drawing.USB, "RS-232, 9600 baud 8N1", (), "Its maker.", ("Note.",), 20
)
GUEST = replace(
    CARRYOUT_G2,
    name="Guest dish",
    firmware="guest",
    tells_version=False,
    type_field="",
    floor_settings=(Setting("row.floor", "row F"),),
    ceiling_settings=(Setting("row.top", "row T"),),
    search_setting=SearchSetting("row.tv", "row TV", "Find TV", off="no", on="yes"),
    connectors=(PLUG,),
    adapters=(),
)


def bench(facts=GUEST, **readings):
    told = {f"row.{name}": SimpleNamespace(value=value) for name, value in readings.items()}
    state = SimpleNamespace(
        dish=facts, readings=told, surveyed=True, firmware_version=None, search=TvSearch.UNKNOWN,
        el_min_deg=10.0, el_max_deg=80.0, el_offset_deg=0.0,
    )  # fmt: skip
    own = SimpleNamespace(min_elevation_deg=None, max_elevation_deg=None, cable_min_deg=None, cable_max_deg=None)
    return SimpleNamespace(is_up=True, state=state, settings=SimpleNamespace(motion=own), kept=lambda _name: None)


@pytest.mark.parametrize(
    ("facts", "readings", "says"),
    [
        (GUEST, {"floor": "10", "top": "80"}, "(read from the dish)"),
        (GUEST, {"floor": "10"}, "(of the model: not read from this dish)"),
        (replace(GUEST, ceiling_settings=()), {"floor": "10"}, "(floor read from the dish: row F is 10)"),
        (replace(GUEST, ceiling_settings=(), floor_settings=()), {"floor": "10"}, "(of the model: not read"),
    ],
)
def test_where_its_limits_come_from(facts, readings, says):
    assert says in LimitsStep(bench(facts, **readings)).evidence()


def test_a_dish_that_tells_no_version_is_waited_for_no_longer_and_one_that_does_is():
    assert DishStep(bench()).evidence() == "Guest dish, speaks guest; it tells no version"
    assert DishStep(bench(replace(GUEST, tells_version=True))).evidence() == ""


def test_the_setting_of_its_search_is_named_as_it_names_it():
    assert SearchStep(bench(tv="yes")).evidence() == "on: row TV is yes; the dish moves by itself after power-up"


def test_one_that_never_searches_has_nothing_to_switch_off():
    step = SearchStep(bench(replace(GUEST, search_switch=SearchSwitch.NEVER_SEARCHES, search_setting=None)))
    assert (step.proven, step.choices()) == (True, ())
    assert step.evidence() == "this dish has none"
    assert step.words() == ("This dish has no TV search of its own.",)


def test_its_plug_is_drawn_and_how_long_it_starts_is_told(monkeypatch):
    monkeypatch.setattr(wiring, "list_models", lambda: (CARRYOUT_G2, GUEST))
    monkeypatch.setattr(wiring, "model_of", {"guest": GUEST}.get)
    assert wiring.connectors_of("guest") == (PLUG,)
    assert [each.key for each in wiring.connectors()] == ["g2", "din"]
    assert wiring.spoken_behind(PLUG) == ("guest",)
    assert "(Guest dish: 20)" in wiring.symptoms()[0].remedy


NETWORKED = replace(GUEST, firmware="networked", baud=0, connectors=(), homing_s=None, never_homes=True)


def test_a_machine_without_homing_is_not_said_to_have_homed():
    step = HomeStep(bench(NETWORKED))
    assert step.proven is True
    assert step.evidence() == "this dish has no homing"
    assert step.words() == ("The Guest dish has no homing.",)


def test_a_machine_on_no_serial_line_is_shown_no_other_dish_s_plugs(monkeypatch):
    monkeypatch.setattr(wiring, "model_of", {"networked": NETWORKED, "guest": replace(GUEST, connectors=())}.get)
    assert wiring.connectors_of("networked") == ()
    assert wiring.connectors_of("guest") == wiring.connectors()


def test_a_machine_on_no_serial_line_has_no_speed_to_show_or_keep():
    kept = {}
    link = SimpleNamespace(state=LinkPhase.UP, round_trip_s=0.004, reason=None, detail="")
    state = SimpleNamespace(dish=NETWORKED, port="socket://192.0.2.9:4000", link=link, activity=Activity.IDLE)
    step = LinkStep(SimpleNamespace(
        state=state, settings=SimpleNamespace(dish=SimpleNamespace(baud=None)), kept=lambda _name: None, ports=list,
        now=0.0, overridden=lambda *_: "", done=lambda _name, _evidence, keys: kept.update(keys),
    ))  # fmt: skip
    assert step.evidence() == "socket://192.0.2.9:4000, answers in 4 ms"
    step._keep()
    assert kept["dish.baud"] is None, "0 is no speed that the file may hold"
