"""`birdcage gear`."""

from __future__ import annotations

import click

from birdcage.base.reason import Reason
from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted


@click.command("gear", epilog=exits.EPILOG)
@click.option("--play-az", type=float, metavar="DEG", help="Set the play of the azimuth.")
@click.option("--play-el", type=float, metavar="DEG", help="Set the play of the elevation.")
@click.option("--forget", is_flag=True, help="Forget both: another dish is at this adapter.")
@global_options()
def command(play_az: float | None, play_el: float | None, forget: bool) -> None:
    """Show this dish's play and overshoot, set the play, or forget both.

    birdcage learns by itself how far past its target an axis comes to rest. It can't measure play, and corrects
    nothing until both are known. Sources have 0.02 to 0.06 degrees for one kind of dish.

    To measure the play: find a strong geostationary satellite, and the angle at which its signal is half-way down one
    side. Go there from 2 degrees below and from 2 degrees above, in small steps. Compare `birdcage pos` where the
    signal is the same: the difference is the play. Take the mean of three each.

    Sends nothing, and opens no port. A birdcage that runs takes it at its next start.
    """
    from datetime import UTC, datetime

    from birdcage.base.errors import ConfigError, LinkError
    from birdcage.cli.say import tell, tell_json
    from birdcage.station.facts_file import FactsFile
    from birdcage.station.gear_words import gear_values, gear_words

    if forget and not (play_az is None and play_el is None):
        raise click.UsageError("--forget goes alone.")
    dish = wanted()
    file = FactsFile.of(dish.paths.state, dish.port, dish.firmware if dish.firmware_given else None)
    if file is None:
        raise LinkError(
            f"No adapter at {dish.port or 'no port'}. birdcage files what it learns of a dish under its adapter. "
            "`birdcage ports` lists them.",
            reason=Reason.MISSING,
        )
    if forget:
        file.forget_gear()
    elif not (play_az is None and play_el is None):
        if file.firmware is None:
            raise ConfigError("Name the firmware with --firmware. `birdcage detect` tells which it is.")
        file.set_play(play_az, play_el, datetime.now(UTC))
    own = file.read()
    if flags().json:
        tell_json({"port": dish.port, "gear": gear_values(own)})
    else:
        tell(gear_words(own) or "This dish's play and overshoot are unknown.")
