"""`birdcage elements update`: the one command that fetches elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG, NOT_DONE, SIGNAL
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from birdcage.sky.update.refresh import RefreshOutcome


@click.command("update", short_help="Fetch groups from CelesTrak, SatNOGS DB or your mirror.", epilog=DATA_EPILOG)
@click.argument("groups", metavar="[GROUP]...", nargs=-1)
@click.option("--force", is_flag=True, help="Ask again within two hours; never during a pause that a server wants.")
@global_options("config", "json", "verbose")
@click.pass_context
def update(context: click.Context, groups: tuple[str, ...], force: bool) -> None:
    """Fetch groups from CelesTrak and SatNOGS DB, or from your own mirror.

    Without a name: those of `elements.groups` in birdcage.toml, or a few. A group that can't be had keeps its elements.
    """
    from birdcage.cli.commands.elements_common import elements_settings, open_catalogue
    from birdcage.cli.say import Progress, say, tell_json
    from birdcage.sky.update.refresh import refresh
    from birdcage.sky.update.sources import DEFAULT_GROUPS, find_sources

    settings = elements_settings()
    names = groups or settings.group_names or DEFAULT_GROUPS
    sources = find_sources(names, mirror_url=settings.mirror_url)
    outcomes: list[RefreshOutcome] = []
    progress = Progress()
    with open_catalogue() as catalogue:
        try:
            for outcome in refresh(
                catalogue, sources, force=force, deadline_s=settings.deadline_s,
                begin=lambda source: progress.show(f"{source.name} …"),
            ):  # fmt: skip
                progress.clear()
                outcomes.append(outcome)
                _tell(outcome)
        except KeyboardInterrupt:
            progress.clear()
            say("Cancelled. What arrived is saved. The rest is unchanged.")
            context.exit(SIGNAL + 2)
    if flags().json:
        tell_json([_values(each) for each in outcomes])
    if not all(each.good for each in outcomes):
        context.exit(NOT_DONE)


def _tell(outcome: RefreshOutcome) -> None:
    from birdcage.cli.say import say, tell

    for complaint in outcome.complaints:
        say(str(complaint))
    if not flags().json:
        tell(f"{outcome.name:14} {outcome.status.value:10} {outcome.sentence}")


def _values(outcome: RefreshOutcome) -> dict[str, object]:
    from birdcage.cli.commands.elements_common import complaint_values
    from birdcage.cli.say import iso

    return {
        "group": outcome.name,
        "status": outcome.status.value,
        "sentence": outcome.sentence,
        "added": None if outcome.added is None else outcome.added._asdict(),
        "complaints": [complaint_values(each) for each in outcome.complaints],
        "next_at": iso(outcome.next_at),
    }
