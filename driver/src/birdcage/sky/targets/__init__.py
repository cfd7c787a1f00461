"""What a dish can be pointed at: satellites, slots, bodies of the solar system, points of the sky, fixed directions."""

from birdcage.sky.targets.model import Target
from birdcage.sky.targets.parse import UnknownTarget, parse_target

__all__ = ["Target", "UnknownTarget", "parse_target"]
