"""No `q` ever reaches a root prompt, within the fault model of SEAMS *Codec*."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest
from birdcage.sim.port import open_port
from birdcage.sim.wire import PASS, Byte
from hypothesis import HealthCheck, given, settings

bench, scripted = sys.modules["console_bench"], sys.modules["console_scripted"]


class Faults:
    """What happens to the bytes of one direction, one by one; `lag_s` holds for all of them."""

    def __init__(self, faults) -> None:
        self.lag_s = 0.0
        self._actions = self._plan(faults)

    @staticmethod
    def _plan(faults):
        for skip, kind, late_s, noise in faults:
            for _ in range(skip):
                yield PASS
            yield Byte(drop=kind == "drop", double=kind == "double", delay_s=late_s, noise=noise)

    def __call__(self, value: int) -> Byte:
        action = next(self._actions, PASS)
        return replace(action, delay_s=max(action.delay_s, self.lag_s))

    def scripted(self, value: int) -> list[tuple[float, bytes]]:
        action = self(value)
        data = b"" if action.drop else bytes([value]) * (2 if action.double else 1)
        return [(action.delay_s, bytes([one])) for one in action.noise + data]


def drive(port, clock, steps, lanes, alive, dialect=bench.DIALECT, names=None) -> None:
    """Do the steps; `alive` looks at the dish itself."""
    owner = bench.Owner(port, clock, dialect, names)
    for lags, nudge, action in steps:
        for lane, lag_s in zip(lanes, lags, strict=True):
            lane.lag_s = lag_s
        owner.step(nudge, action)
        assert alive(), (nudge, action)
    clock.advance(60.0)
    assert alive()
    clock.wake.close()


def drive_simulator(steps, to_dish, to_host, address="g2?root_q=kill", **dialect) -> None:
    clock, lanes = bench.NudgingClock(), (Faults(to_dish), Faults(to_host))
    port = open_port(address, clock=clock)
    port.wire.to_dish.set_plan(lanes[0])
    port.wire.to_host.set_plan(lanes[1])
    drive(port, clock, steps, lanes, lambda: port.dish.truth().shell_alive, **dialect)


def drive_scripted(steps, to_dish, to_host, dialect=bench.DIALECT, **script) -> None:
    clock, lanes = bench.NudgingClock(), (Faults(to_dish), Faults(to_host))
    dish = scripted.Dish(clock, **script)
    dish.in_fault, dish.out_fault = lanes[0].scripted, lanes[1].scripted

    def alive() -> bool:
        dish.pending()
        return dish.alive

    drive(dish, clock, steps, lanes, alive, dialect)


SCRIPTS = {
    "named": {"dialect": bench.LEARNT, "help_of": scripted.HELP_OF},
    "alike": {"dialect": bench.LEARNT, "help_of": scripted.HELP_OF, "prompts": scripted.ALIKE},
}
LEARNT_SIMULATORS = [f"hal205?root_q=kill&prompts={prompts}" for prompts in ("named", "alike")]
"""Where prompts are learnt: decision 0010."""


QUICK = settings(max_examples=1000, derandomize=True, deadline=None, database=None)
BRIEF = settings(QUICK, max_examples=300)
LONG = settings(max_examples=5_000, deadline=None, database=None, suppress_health_check=list(HealthCheck))
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


@pytest.mark.parametrize("address", LEARNT_SIMULATORS)
@BRIEF
@drawn
def test_no_q_reaches_the_root_of_a_simulated_travler(address, steps, to_dish, to_host):
    drive_simulator(steps, to_dish, to_host, address, dialect=bench.HAL, names=bench.HAL_NAMES)


@pytest.mark.soak
@LONG
@drawn
def test_no_q_reaches_the_simulators_root_however_long(steps, to_dish, to_host):
    drive_simulator(steps, to_dish, to_host)


@pytest.mark.soak
@LONG
@drawn
def test_no_q_reaches_the_scripted_root_however_long(steps, to_dish, to_host):
    drive_scripted(steps, to_dish, to_host)


@pytest.mark.soak
@pytest.mark.parametrize("script", SCRIPTS)
@LONG
@drawn
def test_no_q_reaches_a_scripted_learnt_root_however_long(script, steps, to_dish, to_host):
    drive_scripted(steps, to_dish, to_host, **SCRIPTS[script])
