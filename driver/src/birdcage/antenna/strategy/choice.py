"""Which strategy suits a machine: the one place that asks what a second move does to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.antenna.strategy.queue import Block, Queue
from birdcage.antenna.strategy.retarget import Retarget
from birdcage.antenna.strategy.strategy import MotionStrategy
from birdcage.antenna.strategy.timed import Timed
from birdcage.rotator.facts import Facts, SecondMove

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna


def suited(facts: Facts) -> type[MotionStrategy]:
    """Return the strategy for a machine with these facts."""
    if not facts.tells_at_rest:
        return Timed
    if not facts.moves_in_turn:
        return Retarget
    return Block if SecondMove.BLOCK in (facts.second_same, facts.second_other) else Queue


def strategy_for(antenna: BirdcageAntenna) -> MotionStrategy:
    """Return how an antenna's machine is moved and stopped."""
    return suited(antenna.model)(antenna)
