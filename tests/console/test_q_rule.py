"""No `q` ever reaches a root prompt, within the fault model of `docs/decisions/0003-q-in-step.md`."""

from __future__ import annotations

import sys
from functools import partial

import pytest
from birdcage.sim.port import open_port
from hypothesis import HealthCheck, Phase, given, seed, settings
from night import by_night

bench, scripted, nested = (sys.modules[f"console_{name}"] for name in ("bench", "scripted", "nested"))


def count_lines(port) -> list[int]:
    """Note how many lines each write to the port holds."""
    counts, write = [], port.write

    def writing(data: bytes) -> None:
        counts.append(data.count(b"\r"))
        write(data)

    port.write = writing
    return counts


def drive(port, clock, steps, lanes, alive, dialect=bench.DIALECT, names=None) -> int:
    """Do the steps; `alive` looks at the dish itself. Return how many lines went out."""
    sent = count_lines(port)
    owner = bench.Owner(port, clock, dialect, names)
    for lags, nudge, action in steps:
        for lane, lag_s in zip(lanes, lags, strict=True):
            lane.lag_s = lag_s
        owner.step(nudge, action)
        assert alive(), (nudge, action)
    clock.advance(60.0)
    assert alive()
    clock.wake.close()
    return sum(sent)


def drive_simulator(steps, to_dish, to_host, address="g2?root_q=kill", **dialect) -> int:
    clock, lanes = bench.NudgingClock(), (bench.Faults(to_dish), bench.Faults(to_host))
    port = open_port(address, clock=clock)
    port.wire.to_dish.set_plan(lanes[0])
    port.wire.to_host.set_plan(lanes[1])
    return drive(port, clock, steps, lanes, lambda: port.dish.truth().shell_alive, **dialect)


def drive_scripted(
    steps, to_dish, to_host, dialect=bench.DIALECT, make=scripted.Dish, names=None, **script
) -> int:  # fmt: skip
    clock, lanes = bench.NudgingClock(), (bench.Faults(to_dish), bench.Faults(to_host))
    dish = make(clock, **script)
    dish.in_fault, dish.out_fault = lanes[0].scripted, lanes[1].scripted

    def alive() -> bool:
        dish.pending()
        return dish.alive

    return drive(dish, clock, steps, lanes, alive, dialect, names)


SCRIPTS = {
    "named": {"dialect": bench.LEARNT, "help_of": scripted.HELP_OF},
    "alike": {"dialect": bench.LEARNT, "help_of": scripted.HELP_OF, "prompts": scripted.ALIKE},
}
NESTED_NAMES = {"dvb": "odu", "agc": "?"}
"""What the drawn steps mean where menus lie in a menu."""
NESTED = {
    "nested": {"dialect": nested.KNOWN},
    "nested learnt": {"dialect": nested.LEARNT},
    "nested alike": {"dialect": nested.LEARNT, "prompts": nested.ALIKE},
}
for _script in NESTED.values():
    _script.update(make=nested.Dish, names=NESTED_NAMES)
LEARNT_SIMULATORS = {
    f"{firmware}?root_q=kill&prompts={prompts}{'&odu_q=kill' if firmware == 'pro' else ''}": kind
    for firmware, kind in bench.TRAVLERS.items() for prompts in ("named", "alike")
}  # fmt: skip
"""Where prompts are learnt: decision 0010."""


QUICK = settings(max_examples=1000, derandomize=True, deadline=None, database=None)
BRIEF = settings(QUICK, max_examples=150)
"""The same examples every time. Fewer of QUICK miss a `q` that goes out without its proof."""
LONG = settings(
    max_examples=750, derandomize=False, deadline=None, database=None, suppress_health_check=list(HealthCheck),
    phases=(Phase.generate,),
)  # fmt: skip
"""What fails is told as it was drawn: making it small would outlast a test's minute."""
drawn = given(bench.STEPS, bench.FAULTS, bench.FAULTS)


@QUICK
@drawn
def test_no_q_reaches_the_simulators_root(steps, to_dish, to_host):
    drive_simulator(steps, to_dish, to_host)


@QUICK
@drawn
def test_no_q_reaches_the_scripted_root(steps, to_dish, to_host):
    drive_scripted(steps, to_dish, to_host)


@pytest.mark.parametrize("script", SCRIPTS)
@BRIEF
@drawn
def test_no_q_reaches_a_scripted_root_whose_prompt_was_learnt(script, steps, to_dish, to_host):
    drive_scripted(steps, to_dish, to_host, **SCRIPTS[script])


@pytest.mark.parametrize("script", NESTED)
@BRIEF
@drawn
def test_no_q_reaches_the_root_below_which_menus_are_two_deep(script, steps, to_dish, to_host):
    drive_scripted(steps, to_dish, to_host, **NESTED[script])


@pytest.mark.parametrize("address", LEARNT_SIMULATORS)
@BRIEF
@drawn
def test_no_q_reaches_the_root_of_a_simulated_travler(address, steps, to_dish, to_host):
    drive_simulator(steps, to_dish, to_host, address, **LEARNT_SIMULATORS[address])


DISHES = {
    "g2": drive_simulator,
    **{address: partial(drive_simulator, address=address, **kind) for address, kind in LEARNT_SIMULATORS.items()},
    "scripted": drive_scripted,
    **{f"scripted {name}": partial(drive_scripted, **script) for name, script in (SCRIPTS | NESTED).items()},
}
PARTS, SHARE = 4, 4_200
"""Every dish goes through so many parts of so many exchanges at least: each part ends well within a minute."""


def test_the_soak_is_of_a_hundred_thousand_exchanges():
    assert len(DISHES) * PARTS * SHARE >= 100_000


@pytest.mark.soak
@pytest.mark.parametrize("part", by_night(range(PARTS), 1))
@pytest.mark.parametrize("dish", by_night(DISHES, 3))
def test_no_q_reaches_a_root_in_a_hundred_thousand_exchanges(dish, part):
    """A hundred thousand in all parts of a night together; `SHARE` in this one. An exchange is a line that was sent."""
    exchanges = 0

    @seed(part)
    @LONG
    @drawn
    def tell(steps, to_dish, to_host):
        nonlocal exchanges
        exchanges += DISHES[dish](steps, to_dish, to_host)

    tell()
    assert exchanges >= SHARE
