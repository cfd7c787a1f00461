"""A machine that its port names by its scheme: asked in its own language, as no console is to be expected there."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.rotator import machines
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.values import Survey


@dataclass(frozen=True, slots=True)
class MetMachine:
    """What became of meeting it."""

    name: str
    """What such machines are called."""
    told: str
    """What it tells of itself, in a few words; empty where it tells nothing."""
    silence: str = ""
    """Why it was not met, as a sentence; empty where it was."""


def meet_machine(firmware: str, port: str, clock: Clock, hooks: Hooks) -> MetMachine:
    """Open a machine at its port, ask who it is, and let go of it. Nothing moves. LinkError for a port without one."""
    machine = machines.make(firmware)
    name = machines.facts_of(firmware).name
    machine.open(port, None, clock, hooks)
    try:
        machine.begin(lambda _sentence: None)
        machine.meet()
        try:
            survey = machine.survey()
        except CommandRefused:
            survey = Survey()
        labels = {each.id: each.label for each in machine.facts.features.values()}
        told = [f"{labels.get(key, key)}: {value}" for key, value in survey.features.items()]
        told += [f"{key} {text}" for key, text in survey.identity.items()]
        return MetMachine(name, ", ".join(told))
    except NoReply as silence:
        return MetMachine(name, "", str(silence))
    finally:
        machine.close(0.0)
