"""What a motor test says: of an axis, of its drivers, and why a machine can't be measured."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.diagnostics.motor_test_records import MotorTest
from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts, Readback

FAR_OFF = 0.10
"""A figure that is off by more than this share of what is expected calls for a look."""
SIGMAS = 2.0
"""And by so many of its own sigmas: else it may be chance."""
NOT_ASKED = "The motor test moves the dish only when a person asks for it."


def not_measured(dish: Facts) -> str:
    """Return why the motors of a machine can't be measured by its position, as a sentence; empty if they can."""
    if dish.no_following:
        return f"{dish.no_following} Its motors can't be tested one by one. Nothing was sent."
    if dish.readback is not Readback.ALWAYS:
        tells = "tells where it is only on its way" if dish.readback is Readback.MOVING else "never tells where it is"
        return f"The {dish.name} {tells}, so its speed can't be measured. Nothing was sent."
    if dish.slew is not None:
        return (
            f"The {dish.name} moves in silence: any byte would stop it. Its speed can't be measured. Nothing was sent."
        )
    if dish.moves_in_turn or not dish.moves_one_axis:
        return (
            f"The {dish.name} takes one move at a time and may not answer meanwhile. Its speed can't be measured. "
            "Nothing was sent."
        )
    return ""


def no_room(axis: Axis, way_deg: float, least_deg: float, refused: str) -> str:
    """Return the sentence for an axis that can't be sent to and fro where the dish stands."""
    why = refused.removesuffix(" Nothing was sent.")
    return (
        f"{axis.name.capitalize()} has only {way_deg:.1f}° to turn in from here, and a test needs {least_deg:g}°. "
        f"{why + ' ' if why else ''}Nothing was measured. Move the dish away from there first."
    )


def axis_words(test: MotorTest) -> str:
    """Say what was measured of an axis against what was expected, and what to do where it is far off."""
    speed = figure_words(test.speed, "°/s", test.speed_nominal, "speed not measured")
    acceleration = figure_words(test.acceleration, "°/s²", test.acceleration_nominal, "acceleration not measured")
    name = test.axis.capitalize()
    words = f"{name}: {speed}, {acceleration}, no stall seen over {test.way_deg:.0f}°."
    off = [
        f"Its {what} is {abs(share):.0%} {'above' if share > 0.0 else 'below'} nominal."
        for what, figure, nominal in (
            ("speed", test.speed, test.speed_nominal), ("acceleration", test.acceleration, test.acceleration_nominal),
        ) if (share := off_by(figure, nominal)) is not None
    ]  # fmt: skip
    if not off:
        return words
    return f"{words} {' '.join(off)} Check its settings for speed and acceleration, and home it: its angles may be off."


def off_by(figure: tuple[float, float] | None, nominal: float | None) -> float | None:
    """Return by which share a figure is far off; None where it is not, or not surely, or nothing is expected."""
    if figure is None or nominal is None:
        return None
    value, sigma = figure
    apart = value - nominal
    return apart / nominal if abs(apart) > FAR_OFF * nominal and abs(apart) > SIGMAS * sigma else None


def driver_words(dish: Facts, drivers: Mapping[str, str]) -> str:
    """Say what the motor drivers tell, by the ids of features; empty where none was asked."""
    words = []
    for name, said in drivers.items():
        feature = dish.features[name]
        mark = feature.health
        if mark is not None and mark.is_good(said) is False:
            words.append(f"The {mark.label} says {said}: cut the power, look for what blocks the motor, and home it.")
    if words:
        return " ".join(words)
    return "The motor drivers report no fault." if drivers else ""


def figure_words(figure: tuple[float, float] | None, unit: str, nominal: float | None, none: str) -> str:
    """Return a figure with its sigma and what it should be: `64.8 ±0.4 °/s of 65`; `none` where there is no figure."""
    if figure is None:
        return none
    value, sigma = figure
    digits = 1 if value < 100.0 else 0
    of = "" if nominal is None else f" of {nominal:.{digits}f}".removesuffix(".0")
    return f"{value:.{digits}f} ±{max(sigma, 10**-digits):.{digits}f} {unit}{of}"
