"""The option `--source`: by which of its sources a command hears."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

import click

if TYPE_CHECKING:
    from birdcage.base.config import Settings

Command = TypeVar("Command", bound=Callable[..., object])


def source_option(command: Command) -> Command:
    """Give a command the option, as `source`: None for the source that the mounted feed names."""
    add = click.option("--source", metavar="NAME",
                       help="Hear by this one: tuner, rigctl, satdump, gqrx, sdrpp, rtl_tcp, rtl_power, or the name of "
                       "a [signal.NAME] of yours.  [default: the feed's]")  # fmt: skip
    return add(command)


def heard_by(source: str | None, settings: Settings) -> str:
    """Return the id of the source that counts. click.BadParameter for one that there is not."""
    from birdcage.base.config.signals import OWN_TUNER, RECEIVER

    known = (OWN_TUNER, RECEIVER, *settings.signals)
    if source is not None and source not in known:
        raise click.BadParameter(f"There is no source {source!r}. There are {', '.join(known)}.", param_hint="--source")
    return source or settings.active_feed.signal
