"""`birdcage motors run`."""

from __future__ import annotations

from typing import Any

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among

HOLDER = "birdcage motors run"
LEAST_S, MOST_S = 0.5, 5.0
"""In less, a slow motor is not seen to turn; in more, a dish is far from where a person looks."""


@click.command("run", epilog=EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("feature")
@click.argument("value")
@click.option(
    "--seconds", type=click.FloatRange(LEAST_S, MOST_S), default=1.0, show_default=True, help="How long it runs."
)
@click.option("--yes", is_flag=True, help="Do not ask.")
@global_options()
def run(feature: str, value: str, seconds: float, yes: bool) -> None:
    """Run a motor without a target for some seconds, then send STOP. Ctrl+C sends STOP at once.

    FEATURE is a motor of this dish, for example duty.azimuth. VALUE says how fast it runs and which way. `birdcage
    features` lists both. Nothing is planned ahead: STOP goes out as soon as the position that is read comes near a
    limit or a no-go sector. So it does where the motor is not seen to turn. The exit status is 1 then.

    If another birdcage program has the port, that one runs it. It needs a machine that has such a motor, tells its
    position while it moves, and has a STOP of its own.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.commands.get import confirm
    from birdcage.cli.dish_features import list_features
    from birdcage.cli.motor_run import RunElsewhere, run_motor
    from birdcage.cli.say import position_lines, position_values, say, tell, tell_json

    no_options_among([feature, value])
    dish_wanted = wanted()
    row = _motor(list_features(dish_wanted)["features"], feature)
    speed = _speed(row, value)
    confirm(_consequence(row, speed, seconds), yes, "Run it?")
    with reach_dish(dish_wanted, HOLDER, moves=True, attached=RunElsewhere) as dish:
        dish.come_up(15.0)
        turned = run_motor(dish, feature, speed, seconds, HOLDER)
        demo = dish.state.demo
    if flags().json:
        tell_json({**position_values(turned.position), "turned_deg": round(turned.by_deg, 3), "demo": demo})
    else:
        tell(position_lines(turned.position))
        say(f"The {turned.axis} turned by {turned.by_deg:+.2f}°, and STOP was sent.")


def _motor(rows: list[dict[str, Any]], feature: str) -> dict[str, Any]:
    """Return the row of a motor. CommandRefused for what is none, with those that there are."""
    from birdcage.base.errors import CommandRefused
    from birdcage.rotator.feature import FeatureKind

    motors = {row["id"]: row for row in rows if row["kind"] == FeatureKind.HELD.value}
    if feature not in motors:
        has = f"It has {' and '.join(motors)}." if motors else "It has none."
        raise CommandRefused(
            f"This dish has no motor {feature} that can be run without a target. {has} Nothing was sent.",
            reason=Reason.UNSUPPORTED,
        )
    return motors[feature]


def _speed(row: dict[str, Any], typed: str) -> float:
    """Return what was typed as a number that is not 0. UsageError for anything else, OutOfRange beyond its range."""
    from birdcage.base.errors import OutOfRange

    try:
        value = float(typed)
    except ValueError:
        value = 0.0
    if not value:
        raise click.UsageError(f"{row['id']} is {typed!r}. Give a number that is not 0.")
    if not row["low"] <= value <= row["high"]:
        raise OutOfRange(f"{row['label']}: {value:g} is outside {row['low']:g} to {row['high']:g}. Nothing was sent.")
    return value


def _consequence(row: dict[str, Any], value: float, seconds: float) -> str:
    return (
        f"{row['label']}: at {value:+g} for {seconds:g} s, without a target. Only its first moment is "
        "checked ahead. birdcage sends STOP when the time is over, at Ctrl+C, and where the position that it reads "
        f"comes near a limit or a no-go sector. {row['hazard'] or ''}".rstrip()
    )
