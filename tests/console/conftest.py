"""A scripted dish and a session on it, on a virtual clock."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest


def _load(name: str):
    spec = importlib.util.spec_from_file_location(f"console_{name}", Path(__file__).with_name(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


bench, scripted = _load("bench"), _load("scripted")
nested = _load("nested")


@pytest.fixture
def clock():
    made = bench.NudgingClock()
    yield made
    made.wake.close()


@pytest.fixture
def dish(clock):
    return scripted.Dish(clock)


@pytest.fixture
def owner(dish, clock):
    return bench.Owner(dish, clock)


@pytest.fixture
def console(owner):
    return owner.console
