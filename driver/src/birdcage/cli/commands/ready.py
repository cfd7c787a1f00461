"""`birdcage ready`."""

from __future__ import annotations

import click

from birdcage.cli.exits import DATA_EPILOG, NOT_DONE
from birdcage.cli.options import find_paths, flags, global_options, load_settings


@click.command("ready", short_help="Check what is missing before you leave home.", epilog=DATA_EPILOG)
@click.option("--try-recording", is_flag=True,
              help="Tell the receiver AOS and, 2 s later, LOS. It records if that is armed; a recording under way "
                   "ends.")  # fmt: skip
@global_options("port", "firmware", "config", "json", "verbose")
@click.pass_context
def command(context: click.Context, try_recording: bool) -> None:
    """Check all that is needed without a network: elements, clock, ephemeris, place, port, settings.

    No port is opened and the dish stays as it is. A receiver, where one is set, is asked for frequency, level and
    modes. Whether it records shows only with --try-recording. ✓ is good, ! is worth a check, ✗ must be fixed:
    then the exit status is 1.
    """
    from birdcage.base.clock import RealClock
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.ready.check import GLYPHS
    from birdcage.ready.checks import checks

    paths = find_paths()
    found = list(checks(paths, load_settings(paths), RealClock().utc(), try_recording=try_recording))
    must = sum(each.state == "must" for each in found)
    look = sum(each.state == "look" for each in found)
    if flags().json:
        rows = [{"name": e.name, "state": e.state, "words": e.words, "remedy": e.remedy or None} for e in found]
        tell_json({"ready": not must, "checks": rows})
    else:
        width = max(len(each.name) for each in found)
        for each in found:
            tell(f"{GLYPHS[each.state]} {each.name:{width}}  {each.words}")
            if each.remedy:
                tell(f"  {'':{width}}  → {each.remedy}")
    if must:
        say(f"Not ready: {must} to fix{f', {look} to check' if look else ''}.")
        context.exit(NOT_DONE)
    say(f"Ready; {look} to check." if look else "Ready.")
