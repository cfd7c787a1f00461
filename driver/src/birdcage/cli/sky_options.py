"""The options of the commands that look at the sky: from where, and at what; each with what it comes to."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli.options import AnyCallable

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.base.config import Settings
    from birdcage.sky.observer import Observer


class UtcTime(click.ParamType["datetime"]):
    """A time in ISO 8601; without a zone it is UTC."""

    name = "TIME"

    def convert(self, value: str | datetime, param: click.Parameter | None, ctx: click.Context | None) -> datetime:
        """Return the time, aware and in UTC."""
        from datetime import UTC, datetime

        if isinstance(value, datetime):
            return value
        try:
            when = datetime.fromisoformat(value)
        except ValueError:
            self.fail(f"{value!r} is not a time. Type 2026-11-21T18:30:00Z.", param, ctx)
        return when.replace(tzinfo=UTC) if when.tzinfo is None else when.astimezone(UTC)


UTC_TIME = UtcTime()


class FrequencyType(click.ParamType["float"]):
    """A frequency in Hz, from text with a unit; a bare number is in MHz."""

    name = "FREQ"

    def convert(self, value: str | float, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return hertz."""
        from birdcage.sky.band import parse_frequency

        if isinstance(value, float):
            return value
        try:
            return parse_frequency(value)
        except ValueError as error:
            self.fail(str(error), param, ctx)


FREQUENCY = FrequencyType()
NEGATIVE_NUMBERS = {"ignore_unknown_options": True}
"""Settings of a command whose arguments may be such; `no_options_among` finds what is none."""


def no_options_among(words: Iterable[str]) -> None:
    """Raise NoSuchOption for what begins as an option and is no negative number: it is one, mistyped."""
    for word in words:
        if word.startswith("-") and not word.lstrip("-.")[:1].isdigit():
            raise click.NoSuchOption(word)


def at_option(text: str, *, old_name: str | None = None) -> Callable[[AnyCallable], AnyCallable]:
    """Add `--at TIME` to a command, which gets it as `at`. `old_name` goes on to work, and is not shown."""

    def keep(context: click.Context, _parameter: click.Parameter, value: datetime | None) -> None:
        if value is not None:
            context.meta[__name__] = value

    def take(context: click.Context, _parameter: click.Parameter, value: datetime | None) -> datetime | None:
        return value if value is not None else context.meta.get(__name__)

    def decorate(function: AnyCallable) -> AnyCallable:
        told = f"{text} ISO 8601; UTC unless it names a zone.  [default: now]"
        function = click.option("--at", type=UTC_TIME, callback=take, help=told)(function)
        if old_name is not None:
            hidden = click.option(
                old_name, type=UTC_TIME, callback=keep, expose_value=False, hidden=True, is_eager=True
            )
            function = hidden(function)
        return function

    return decorate


def observer_options(function: AnyCallable) -> AnyCallable:
    """Add `--lat`, `--lon` and `--alt` to a command; `find_observer` takes what they hold."""
    for name, metavar, kind, text in (
        ("--alt", "M", click.FloatRange(-500.0, 9000.0), "Height in metres.  [default: as set, or 0]"),
        ("--lon", "DEG", click.FloatRange(-180.0, 180.0), "Longitude, east positive."),
        (
            "--lat",
            "DEG",
            click.FloatRange(-90.0, 90.0),
            "Latitude, north positive.  [default: of the active place]",
        ),
    ):
        function = click.option(name, type=kind, metavar=metavar, help=text)(function)
    return function


def elements_option(function: AnyCallable) -> AnyCallable:
    """Add `--elements` to a command; `known_satellites` takes what it holds."""
    return click.option(
        "--elements", type=click.Path(exists=True, path_type=Path), metavar="FILE",
        help="Elements from a file or folder in any known format.  [default: the catalogue]",
    )(function)  # fmt: skip


def find_observer(settings: Settings, lat: float | None, lon: float | None, alt: float | None) -> Observer:
    """Return where the dish stands: the options over `[place]` of the settings.

    ConfigError when neither names a place, or half of one.
    """
    from birdcage.base.errors import ConfigError
    from birdcage.sky.observer import Observer

    place = settings.place
    if (lat is None) != (lon is None):
        raise ConfigError("--lat and --lon go together: a place needs both.")
    if lat is not None and lon is not None:
        return Observer(lat, lon, alt if alt is not None else 0.0)
    if place.latitude_deg is None or place.longitude_deg is None:
        raise ConfigError(
            "No place is set. `birdcage place add home WHERE --use` sets one: a city, a locator (JO21jv), or two "
            "angles. --lat and --lon count for one command."
        )
    height_m = alt if alt is not None else place.height_m
    return Observer(place.latitude_deg, place.longitude_deg, height_m, place.name or "")
