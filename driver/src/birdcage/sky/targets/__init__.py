"""What a dish can be pointed at: satellites, slots, bodies of the solar system, points of the sky, fixed directions."""

from birdcage.sky.targets.model import Target
from birdcage.sky.targets.resolution import Resolution, TargetCandidate, UnknownTarget
from birdcage.sky.targets.resolve import Resolver

__all__ = ["Resolution", "Resolver", "Target", "TargetCandidate", "UnknownTarget"]
