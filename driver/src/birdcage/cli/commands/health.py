"""`birdcage health`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import NOT_DONE
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from datetime import datetime
    from pathlib import Path

    from birdcage.diagnostics.health import DishHealth

EPILOG = """\b
Exit status:
  0    nothing needs attention; there may be notes
  1    something does
  2    wrong command line or settings
  70   a fault of birdcage
  130  Ctrl+C"""


@click.command("health", epilog=EPILOG)
@click.option("--days", type=click.IntRange(1, 365), default=30, show_default=True,
              help="How far back to look; as many days before that are compared with.")  # fmt: skip
@click.option("--acknowledge", "seen", metavar="ID", multiple=True,
              help="Mark a finding as seen. It returns when it happens again or gets worse, and after "
              "--days if it is still so.")  # fmt: skip
@click.option("--quick", is_flag=True, help="Do not ask the dish: its history only.")
@global_options()
@click.pass_context
def command(context: click.Context, days: int, seen: tuple[str, ...], quick: bool) -> None:
    """Show what needs attention, most urgent first, and what to do.

    It goes by the history that every birdcage program keeps: stalls, restarts, lost replies, wear. If the dish
    answers, or another birdcage program has its port, its present state counts too. Nothing is moved.

    ✗ needs attention now, ! soon, · is worth knowing. Turns are degrees there and back, in full circles.
    """
    from birdcage.base.clock import RealClock
    from birdcage.cli.health_look import look, whose
    from birdcage.cli.health_report import health_values, tell_health
    from birdcage.cli.say import say, tell_json
    from birdcage.diagnostics.health import read_health

    dish, now = wanted(), RealClock().utc()
    name, state = whose(dish, look(dish, asks=not quick))
    journal = dish.paths.journal
    health = read_health(journal, state, now, dish=name, days=days)
    if seen:
        _acknowledge(journal, health, seen, now, days)
        health = read_health(journal, state, now, dish=name, days=days)
    if flags().json:
        tell_json(health_values(health))
    elif not seen:
        tell_health(health)
    left = sum(each.needs_you for each in health.findings)
    if left:
        say("1 finding needs attention." if left == 1 else f"{left} findings need attention.")
        context.exit(NOT_DONE)


def _acknowledge(journal: Path, health: DishHealth, ids: tuple[str, ...], now: datetime, days: int) -> None:
    """Keep that these were seen; all of them, or none where one is not there. ConfigError then."""
    from birdcage.base.errors import ConfigError
    from birdcage.cli.say import say
    from birdcage.diagnostics.history import acknowledge

    found = {each.id: each for each in health.findings}
    for each in ids:
        if each not in found:
            there = ", ".join(name for name, finding in found.items() if not finding.lasts)
            raise ConfigError(f"No finding is called {each}. {f'There is: {there}.' if there else 'There is none.'}")
        if found[each].lasts:
            raise ConfigError(f"{found[each].text} That can't be acknowledged: it goes with its cause.")
    for each in ids:
        acknowledge(journal, health.dish, found[each], now)
        say(f"Acknowledged {found[each].seen_until(days)}: {found[each].text}")
