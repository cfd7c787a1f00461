"""Each case of the contract, with a machine that breaks it: the kit must see that."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from birdcage.antenna import legs
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.az_el import AzEl
from birdcage.antenna.motion import start_motion
from birdcage.base.errors import BirdcageError, CommandRefused
from birdcage.protocol.carryout.protocol import CarryoutProtocol
from birdcage.rotator.facts import Facts, Readback, SearchSwitch
from birdcage.rotator.feature import Feature, FeatureKind, Reading, Writer
from birdcage.rotator.feature_table import FeatureRow, FeatureTable
from birdcage.rotator.ladder import StopMeans
from birdcage.rotator.mapping import Site
from birdcage.rotator.values import Look, Position, Taken
from birdcage.station import dish_reader
from birdcage.station.stopper import Stopper
from birdcage.testing import ConsoleScene, Contract, MachineBench, StopScene
from installed_toys import installed

from .simulated import sim


@pytest.fixture(scope="module")
def toys(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import pushy, pushy_twin

        yield pushy.Pushy, pushy_twin.PushyTwin


def claims_to_have_stopped(patch, machine, twin):
    """It answers STOP, and tells from then on that it stands; its motors go on."""
    look = machine.look
    patch.setattr(machine, "stop_now", lambda self, order: setattr(self, "stood", self._told))
    patch.setattr(machine, "settle", lambda self, within_s: (None,))
    patch.setattr(machine, "look", lambda self, **more: getattr(self, "stood", None) or look(self, **more))


def answers_stop_and_does_nothing(patch, machine, twin):
    take = twin._take
    patch.setattr(twin, "_take", lambda self, words: take(self, words if words[0] == "G" else ["T"]))


def sends_both_axes(patch, machine, twin):
    send = machine.send

    def both(self, to, **more):
        for axis in self._told.angles.keys() - to.keys():
            send(self, {axis: self._told.angles[axis]})
        return send(self, to, **more)

    patch.setattr(machine, "send", both)


def tells_its_target_for_its_position(patch, machine, twin):
    look, send = machine.look, machine.send

    def told(self, **more):
        return Look({**look(self, **more).angles, **getattr(self, "aim", {})})

    def sent(self, to, **more):
        self.aim = {**getattr(self, "aim", {}), **to}
        return send(self, to, **more)

    patch.setattr(machine, "look", told)
    patch.setattr(machine, "send", sent)


def moves_when_met(patch, machine, twin):
    meet = machine.meet

    def met(self):
        meet(self)
        self._session.ask("G 1 45.00", re.compile("K"))

    patch.setattr(machine, "meet", met)


def asks_for_no_permit(patch, machine, twin):
    def send(self, to, **more):
        ((axis, deg),) = to.items()
        self._session.ask(f"G {('pan', 'tilt').index(axis)} {deg:.2f}", re.compile("K"))
        return Taken(True, "K", 0.05)

    patch.setattr(machine, "send", send)


def goes_where_it_stood_when_closed(patch, machine, twin):
    patch.setattr(machine, "close", lambda self, within_s: self._link and self._link.write(b"G 1 60.00\n"))


def stops_short(patch, machine, twin):
    send = machine.send

    def short(self, to, **more):
        return send(self, {axis: deg - 0.5 for axis, deg in to.items()}, **more)

    patch.setattr(machine, "send", short)


def is_slow_to_follow(patch, machine, twin):
    go = twin._take

    def late(self, words):
        self.count = getattr(self, "count", 0) + 1
        if words[0] == "G" and self.count % 40 and self.count > 4:
            words = ["G", words[1], str(self.motors[int(words[1])].deg)]
        go(self, words)

    patch.setattr(twin, "_take", late)


def has_another_rung(patch, machine, twin):
    ladder = machine.facts.stop_ladder
    patch.setattr(
        machine, "facts", replace(machine.facts, stop_ladder=(*ladder, replace(ladder[0], means=StopMeans.RELEASE)))
    )  # fmt: skip


def has_a_console_unseen(patch, machine, twin):
    patch.setattr(machine, "raw", object())


def has_a_limit_too_wide(patch, machine, twin):
    """It goes where its facts let it, and does not tell what it refuses."""
    take = twin._take
    wide = replace(machine.facts.elevation, max_deg=85.0)
    patch.setattr(machine, "facts", machine.facts.with_axes(wide))

    def clipped(self, words):
        take(self, [*words[:2], str(min(float(words[2]), 35.0))] if words[0] == "G" and words[1] == "1" else words)

    patch.setattr(twin, "_take", clipped)


def takes_half_the_circle(patch, machine, twin):
    """It counts from -180 to 180, and its facts say nothing of that."""
    send = machine.send

    def refused_beyond(self, to, **more):
        if to.get("pan", 0.0) > 180.0:
            raise CommandRefused("K 2", reason="bad_parameter")
        return send(self, to, **more)

    patch.setattr(machine, "send", refused_beyond)


def counts_an_azimuth_otherwise(patch, machine, twin):
    around = replace(machine.facts.azimuth, min_deg=-180.0, max_deg=180.0)
    patch.setattr(machine, "facts", machine.facts.with_axes(around))


def has_a_lamp_that_is_never_lit(patch, machine, twin):
    lamp = Feature("lamp", "Lamp", kind=FeatureKind.SWITCH, writer=Writer.UNTIL_RESTART, told=False)
    table = FeatureTable(FeatureRow(lamp, write=lambda _machine, on: {"lamp": on}))
    patch.setattr(machine, "feature_table", table)
    patch.setattr(machine, "facts", replace(machine.facts, features=table.features))


def calls_a_feature_by_no_id(patch, machine, twin):
    named = {"Supply": machine.facts.features["supply"]}
    patch.setattr(machine, "facts", replace(machine.facts, features=named))


def says_that_it_searches(patch, machine, twin):
    patch.setattr(machine, "facts", replace(machine.facts, search_switch=SearchSwitch.FOR_GOOD))


def tells_what_cannot_be(patch, machine, twin):
    take = twin._take
    patch.setattr(twin, "_take", lambda self, words: (setattr(self, "supply_v", 300.0), take(self, words)))


def tells_in_another_unit(patch, machine, twin):
    read = machine.read
    patch.setattr(machine, "read", lambda self, ids: {k: replace(v, unit="mV") for k, v in read(self, ids).items()})


def asks_before_it_refuses(patch, machine, twin):
    write = machine.write
    patch.setattr(machine, "write", lambda self, name, value: (self.ask("L", r"L (\d+)"), write(self, name, value))[1])


def takes_any_value(patch, machine, twin):
    patch.setattr(Feature, "check", lambda feature, value: None)


def claims_to_have_taken_it(patch, machine, twin):
    take = twin._take
    patch.setattr(twin, "_take", lambda self, words: take(self, words[:1] if words[0] == "L" else words))
    patch.setattr(machine, "write", lambda self, name, value: Reading(value, "%", 0.0, self.clock.utc()))


def is_read_in_motion(patch, machine, twin):
    patch.setattr("birdcage.station.features.refuse_while_moving", lambda *_: None)


def calls_itself_homed(patch):
    reader = dish_reader.DishReader
    unknown, position = reader.unknown, reader.position

    def homed(look, *args, **more):
        pointing = position(look, *args, **more)
        look._store.change(homed=True)
        return pointing

    patch.setattr(reader, "position", homed)
    patch.setattr(reader, "unknown", lambda look, why: (unknown(look, why), look._store.change(homed=True)))


def confirms_its_stop(patch):
    finish = Stopper._finish
    patch.setattr(Stopper, "_finish", lambda stopper, pending, _, said: finish(stopper, pending, True, said))


def pretends_to_tell(patch):
    """Where it was sent it says to be, as if it were read."""
    begin = CarryoutProtocol.begin_slew

    def sent(self, az_deg, el_deg, skew_deg):
        self.aim = Position(az_deg, el_deg)
        begin(self, az_deg, el_deg, skew_deg)

    patch.setattr(CarryoutProtocol, "model", replace(CarryoutProtocol.model, readback=Readback.ALWAYS))
    patch.setattr(CarryoutProtocol, "begin_slew", sent)
    patch.setattr(CarryoutProtocol, "_read_position", lambda self, busy_s: getattr(self, "aim", Position(100.0, 30.0)))


@pytest.mark.parametrize(("breach", "case"), [
    (calls_itself_homed, "test_it_is_met_without_moving"),
    (calls_itself_homed, "test_a_go_to_arrives_where_the_truth_is"),
    (confirms_its_stop, "test_stop_in_motion_by_each_rung"),
    (confirms_its_stop, "test_stop_at_rest_moves_nothing"),
    (pretends_to_tell, "test_what_is_shown_is_what_the_mechanics_do"),
    (pretends_to_tell, "test_stop_in_motion_by_each_rung"),
])  # fmt: skip
def test_a_machine_that_does_not_tell_is_never_vouched_for(monkeypatch, breach, case):
    scene = StopScene("none", (100.0, 20.0), 2.0, reaches_target=True)
    bench = MachineBench(
        "carryout", sim("carryout?seed=1"), stops=(scene,), console=ConsoleScene("?", "g <az>", "g 100 40")
    )
    getattr(Contract(), case)(bench)
    breach(monkeypatch)
    with pytest.raises(AssertionError):
        getattr(Contract(), case)(bench)


def goes_straight(patch):
    """It models a straight way between two directions, as if both were axes of its own."""
    patch.setattr(legs, "mapped_motion", lambda model, start, az, el, now, *, start_known: start_motion(
        replace(model, mapping=None), start, az - start.azimuth, el, now
    ))  # fmt: skip


def keeps_the_miss_to_itself(patch):
    patch.setattr(BirdcageAntenna, "miss_deg", lambda *_: 0.0)


def goes_to_the_nearest_however_far(patch):
    nearest = AzEl.nearest_allowed
    patch.setattr(AzEl, "nearest_allowed", lambda *given, any_miss: nearest(*given, any_miss=True))


def sets_out_on_a_pass(patch):
    patch.setattr(Facts, "no_following", "")


def never_halts(patch):
    from birdcage_toys import swing_twin

    patch.setattr(swing_twin.SwingTwin, "halt", lambda self: None)


@pytest.mark.parametrize(("breach", "case"), [
    (goes_straight, "test_on_its_way_it_is_shown_where_its_axes_point"),
    (keeps_the_miss_to_itself, "test_a_step_moves_one_axis_and_names_only_that"),
    (goes_to_the_nearest_however_far, "test_what_it_cannot_reach_is_refused_with_the_nearest"),
    (sets_out_on_a_pass, "test_a_pass_is_followed_as_foreseen"),
    (never_halts, "test_stop_in_motion_by_each_rung"),
])  # fmt: skip
def test_a_breach_along_an_arc_is_seen(toys, monkeypatch, breach, case):
    from birdcage_toys import swing_twin

    bench = MachineBench(
        "swing", swing_twin.SwingTwin, stops=(StopScene("command", (60.0, 0.0), 4.0),), near_deg=0.15,
        settings={"site": Site(48.0, 11.0)},
    )  # fmt: skip
    getattr(Contract(), case)(bench)
    breach(monkeypatch)
    with pytest.raises((AssertionError, BirdcageError)):
        getattr(Contract(), case)(bench)


@pytest.mark.parametrize(("breach", "case"), [
    (claims_to_have_stopped, "test_stop_in_motion_by_each_rung"),
    (answers_stop_and_does_nothing, "test_stop_in_motion_by_each_rung"),
    (sends_both_axes, "test_a_step_moves_one_axis_and_names_only_that"),
    (tells_its_target_for_its_position, "test_a_go_to_arrives_where_the_truth_is"),
    (moves_when_met, "test_it_is_met_without_moving"),
    (moves_when_met, "test_pulled_out_at_rest_and_put_back"),
    (asks_for_no_permit, "test_what_stop_has_latched_does_not_go_out"),
    (goes_where_it_stood_when_closed, "test_closing_leaves_it_at_rest"),
    (stops_short, "test_a_go_to_arrives_where_the_truth_is"),
    (is_slow_to_follow, "test_a_pass_is_followed_as_foreseen"),
    (has_another_rung, "test_every_rung_has_a_scene"),
    (has_a_console_unseen, "test_a_line_and_its_answer_or_no_console_at_all"),
    (has_a_limit_too_wide, "test_a_go_to_arrives_where_the_truth_is"),
    (takes_half_the_circle, "test_it_goes_all_round_its_circle"),
    (counts_an_azimuth_otherwise, "test_it_is_found_by_its_name_and_tells_its_facts"),
    (has_a_lamp_that_is_never_lit, "test_what_is_written_is_read_back"),
    (calls_a_feature_by_no_id, "test_its_features_are_well_formed"),
    (says_that_it_searches, "test_its_features_are_well_formed"),
    (tells_what_cannot_be, "test_what_is_read_has_its_unit_and_lies_in_its_range"),
    (tells_in_another_unit, "test_what_is_read_has_its_unit_and_lies_in_its_range"),
    (asks_before_it_refuses, "test_what_it_lacks_is_refused_with_nothing_sent"),
    (takes_any_value, "test_a_value_beyond_its_range_is_refused_with_nothing_sent"),
    (claims_to_have_taken_it, "test_what_is_written_is_read_back"),
    (is_read_in_motion, "test_nothing_is_read_in_motion_that_may_not_be"),
])  # fmt: skip
def test_a_breach_is_seen(toys, monkeypatch, breach, case):
    machine, twin = toys
    bench = MachineBench("pushy", twin, stops=(StopScene("retarget", (100.0, 20.0), 1.0),))
    breach(monkeypatch, machine, twin)
    with pytest.raises((AssertionError, BirdcageError)):
        getattr(Contract(), case)(bench)
