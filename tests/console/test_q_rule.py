"""No `q` ever reaches a root prompt, within the fault model of SEAMS *Codec*."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from birdcage.sim.port import open_port
from birdcage.sim.wire import PASS, Byte


def _sibling(name: str):
    spec = importlib.util.spec_from_file_location(f"console_{name}", Path(__file__).with_name(f"{name}.py"))
    module = sys.modules.setdefault(spec.name, importlib.util.module_from_spec(spec))
    if not hasattr(module, "__test_loaded__"):
        module.__test_loaded__ = True
        spec.loader.exec_module(module)
    return module


bench, scripted = _sibling("bench"), _sibling("scripted")


def plan(faults) -> Iterator[Byte]:
    for skip, kind, late_s, noise in faults:
        for _ in range(skip):
            yield PASS
        yield Byte(drop=kind == "drop", double=kind == "double", delay_s=late_s, noise=noise)


def scripted_plan(faults):
    actions = plan(faults)

    def fault(byte: int) -> list[tuple[float, bytes]]:
        action = next(actions, PASS)
        data = b"" if action.drop else bytes([byte]) * (2 if action.double else 1)
        return [(action.delay_s, bytes([one])) for one in action.noise + data]

    return fault


def drive_simulator(steps, to_dish, to_host) -> None:
    clock = bench.NudgingClock()
    port = open_port("g2?root_q=kill", clock=clock)
    port.wire.to_dish.set_plan(plan(to_dish))
    port.wire.to_host.set_plan(plan(to_host))
    owner = bench.Owner(port, clock)
    for nudge, action in steps:
        owner.step(nudge, action)
        assert port.dish.truth().shell_alive, (nudge, action)
    clock.advance(60.0)
    assert port.dish.truth().shell_alive
    clock.wake.close()


def drive_scripted(steps, to_dish, to_host) -> None:
    clock = bench.NudgingClock()
    dish = scripted.Dish(clock, echo=True)
    dish.in_fault, dish.out_fault = scripted_plan(to_dish), scripted_plan(to_host)
    owner = bench.Owner(dish, clock)
    for nudge, action in steps:
        owner.step(nudge, action)
        dish.pending()
        assert dish.alive, (nudge, action)
    clock.advance(60.0)
    dish.pending()
    assert dish.alive
    clock.wake.close()


QUICK = settings(max_examples=150, derandomize=True, deadline=None, database=None)
LONG = settings(max_examples=20_000, deadline=None, database=None, suppress_health_check=list(HealthCheck))
drawn = given(bench.STEPS, bench.FAULTS, bench.FAULTS)


@QUICK
@drawn
def test_no_q_reaches_the_simulators_root(steps, to_dish, to_host):
    drive_simulator(steps, to_dish, to_host)


@QUICK
@drawn
def test_no_q_reaches_the_scripted_root(steps, to_dish, to_host):
    drive_scripted(steps, to_dish, to_host)


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
