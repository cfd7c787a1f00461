"""Models one axis that is sent somewhere while both may still be on their way: for streams of targets."""

from __future__ import annotations

from dataclasses import replace

from birdcage.antenna.motion import AxisMotion, DishMotion, plan_axis
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import MOTOR_AZIMUTH, Position


def resting(model: Facts, here: Position, now: float) -> DishMotion:
    """Return the model of a dish that stands still at dish angles."""
    axes = ((model.azimuth, here.azimuth), (model.elevation, here.elevation))
    azimuth, elevation = (AxisMotion(axis, plan_axis(axis, deg, deg), now, deg, now) for axis, deg in axes)
    return DishMotion(azimuth, elevation)


def sent_to(motion: DishMotion) -> tuple[float | None, float | None]:
    """Return where each axis was sent, azimuth in [0, 360); None for one that only stands where it was read.

    That may be a little beyond a limit: an axis overshoots.
    """
    az_deg, el_deg = motion.rest
    azimuth, elevation = motion.azimuth.slew.segments, motion.elevation.slew.segments
    return az_deg if azimuth else None, el_deg if elevation else None


def steered(
    model: Facts,
    under_way: DishMotion | None,
    here: Position,
    motor: int,
    deg: float,
    turn_deg: float | None,
    now: float,
    rate: float,
) -> DishMotion:
    """Return the motion that sending one axis to `deg` (the dish's own angle) makes of the one under way.

    `here` is the last position that was read, and `turn_deg` how far the azimuth turns from there where the turn of
    the cable tells; else it goes the short way. The other axis goes on as it was. Where moves queue, it begins when
    what is under way is over.
    """
    before = under_way or resting(model, here, now)
    axis = before.azimuth if motor == MOTOR_AZIMUTH else before.elevation
    begins = now
    if model.moves_in_turn and under_way is not None:
        begins = max(now, under_way.eta(rate))
    position, velocity = axis.modelled(begins, rate)
    if motor == MOTOR_AZIMUTH:
        end = axis.read_deg + (shortest_turn(axis.read_deg, deg) if turn_deg is None else turn_deg)
    else:
        end = deg
    kind = model.numbered[motor]
    sent = replace(
        axis, axis=kind, slew=plan_axis(kind, position, end, velocity), started=begins, streamed=True,
        trusted=axis.is_as_modelled(rate),
    )  # fmt: skip
    return replace(before, azimuth=sent) if motor == MOTOR_AZIMUTH else replace(before, elevation=sent)
