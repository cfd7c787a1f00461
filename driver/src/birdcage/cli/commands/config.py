"""`birdcage config`."""

from __future__ import annotations

from collections.abc import Mapping

import click

from birdcage.base.text import clean
from birdcage.cli import exits
from birdcage.cli.options import find_paths, flags, global_options, load_settings


@click.group("config", epilog=exits.EPILOG)
@global_options("config", "json", "verbose")
def command() -> None:
    """Show and check birdcage.toml. It is never written."""


@command.command("path", epilog=exits.EPILOG)
@global_options("config", "verbose")
def path() -> None:
    """Print where birdcage.toml is, or would be."""
    from birdcage.cli.say import tell

    tell(str(find_paths().config_file))


@command.command("show", epilog=exits.EPILOG)
@global_options()
def show() -> None:
    """Print every setting as it counts now, and where its value comes from.

    feed.NAME.beam is no setting: it is the beam (az x el) that the feed and the dish's reflector make together.
    """
    from birdcage.base.beam import beam_of
    from birdcage.base.config import rows
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.station.known import model_of, wrong_facts

    settings = load_settings(find_paths())
    model = model_of(settings.dish.firmware)
    reflector = None if model is None else model.reflector
    values: dict[str, object] = {}
    for row in rows():
        if not row.section.endswith(".NAME"):
            values[row.path] = getattr(settings.section(row.section), row.key)
    profiles: dict[str, Mapping[str, object]] = {"feed": settings.feeds, "signal": settings.signals}
    for kind, named in profiles.items():
        for name, profile in named.items():
            for row in rows():
                if row.section == f"{kind}.NAME":
                    values[f"{kind}.{name}.{row.key}"] = getattr(profile, row.key)

    def source(key: str) -> str:
        return settings.sources.get(key, "default")

    beams = {f"feed.{name}.beam": beam_of(feed, reflector) for name, feed in settings.feeds.items()}
    if flags().json:
        told: dict[str, object] = {key: {"value": value, "source": source(key)} for key, value in values.items()}
        for key, beam in beams.items():
            told[key] = {"value": None if beam is None else beam.values(), "source": "computed"}
        tell_json(told)
    else:
        for key, value in values.items():
            tell(f"{key:44} {_shown(value):28} {source(key)}")
        for key, beam in beams.items():
            known = "- (needs dish.firmware and the feed's band, or a width)" if beam is None else beam.words
            tell(f"{key:44} {known}")
    for problem in settings.problems:
        say(problem.text)
    for sentence in wrong_facts(settings.dish.firmware, settings):
        say(sentence)


@command.command("check", epilog=exits.EPILOG)
@global_options("config", "verbose")
@click.pass_context
def check(context: click.Context) -> None:
    """Check the settings: name each file, line and key that cannot be read."""
    from birdcage.cli.say import say
    from birdcage.station.known import wrong_facts

    paths = find_paths()
    settings = load_settings(paths)
    wrong = wrong_facts(settings.dish.firmware, settings)
    for sentence in (*(problem.text for problem in settings.problems), *wrong):
        say(sentence)
    if settings.motion_problem is not None or wrong:
        say("Nothing moves until that is fixed.")
    if settings.problems or wrong:
        context.exit(exits.USAGE)
    state = "in order" if paths.config_file.exists() else "absent: every setting has its default"
    say(f"{paths.config_file} is {state}.")


def _shown(value: object) -> str:
    if value is None:
        return "-"
    return str(value).lower() if isinstance(value, bool) else clean(str(value))
