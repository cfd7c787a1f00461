"""`birdcage calibrate`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import DATA_EPILOG, EPILOG
from birdcage.cli.options import NO_DISH, Wanted, find_paths, flags, global_options, load_settings, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, at_option, no_options_among

if TYPE_CHECKING:
    from datetime import datetime
    from pathlib import Path

    from birdcage.base.alignments import AlignmentSet
    from birdcage.calibration.fit import Fit
    from birdcage.calibration.peaks_file import Peaks
    from birdcage.station.state import Pointing

SHOWN = 8
"""How many objects `next` names."""
HOLDER = "birdcage calibrate"


@click.group("calibrate", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def command() -> None:
    """Find how the dish stands: peak on the Sun, the Moon and satellites, fit, and use the result.

    `guide` leads through all of it. By hand: `next` names an object, `birdcage move` and a meter find it, and `add`
    takes the peak. Then `fit` shows the result, `fit --save NAME` keeps it, and `apply NAME` points by it. Moved the
    base? Begin again with `remove --all`.
    """


@command.command("fit", short_help="Fit the pointing model, and show the residuals.", epilog=DATA_EPILOG)
@click.option("--terms", type=click.IntRange(2, 5), help="2: offsets; 4: with tilt; 5: with collimation too.")
@click.option("--save", "name", metavar="NAME", help="Save the fit under this name.")
@global_options("config", "json", "verbose")
def fit_(terms: int | None, name: str | None) -> None:
    """Fit the pointing model to the peaks, and show what is left: residuals, leave-one-out error, condition."""
    from datetime import UTC, datetime

    from birdcage.base.alignments import keep_set
    from birdcage.base.errors import BirdcageError
    from birdcage.calibration.fit import fit
    from birdcage.calibration.terms import OFFSETS_ONLY, TERMS, WITH_TILT
    from birdcage.calibration.work import in_force, priors_for, set_from, sky_error_for
    from birdcage.cli.calibrate_words import fit_values, tell_fit
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.standing import limits_of

    dish = wanted()
    peaks = _read_peaks(dish).entries
    if not peaks:
        raise BirdcageError("No peaks yet. `birdcage calibrate next` names an object, `add` takes one.")
    if terms == 3:
        raise click.UsageError("--terms is 2, 4 or 5: the two tilt terms go together.")
    chosen = None if terms is None else {2: OFFSETS_ONLY, 4: WITH_TILT, 5: TERMS}[terms]
    found: Fit = fit(peaks, priors_for(dish.settings, peaks), in_force(dish.settings), chosen)
    sky_error_deg = sky_error_for(found, limits_of(dish))
    if flags().json:
        tell_json(fit_values(found, sky_error_deg))
    else:
        tell_fit(found, sky_error_deg)
    if found.warning:
        say(found.warning)
    if name is not None:
        keep_set(dish.paths.alignments_file, set_from(dish.settings, found, name, datetime.now(UTC)))
        say(f"Saved as {name}: `birdcage calibrate apply` uses it.")


@command.command("list", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def list_() -> None:
    """Print the peaks and the sets; the set in use has a star.

    A peak's true direction includes the refraction that was set when it was taken.
    """
    from birdcage.base.alignments import is_in_force, load_sets
    from birdcage.cli.calibrate_words import peak_values, set_values, tell_peaks, tell_sets
    from birdcage.cli.say import say, tell, tell_json

    dish = wanted()
    peaks, sets = _read_peaks(dish), load_sets(dish.paths.alignments_file)
    for problem in sets.problems:
        say(problem)
    kept = [(each, is_in_force(each, dish.settings.alignment)) for each in sets.entries]
    if flags().json:
        tell_json({
            "peaks": [peak_values(each) for each in peaks.entries],
            "sets": [set_values(each, in_force=used) for each, used in kept],
        })  # fmt: skip
        return
    if peaks.entries:
        tell_peaks(peaks.entries)
    else:
        say("No peaks yet. `birdcage calibrate next` names an object.")
    if kept:
        tell("")
        tell_sets(kept)
    active = dish.settings.alignment.active
    if active is not None and not any(used for _each, used in kept):
        say(f"In use: {active}, changed since, or its saved set is gone.")


@command.command("apply", short_help="Use a saved set for all pointing.", epilog=DATA_EPILOG)
@click.argument("name")
@global_options("config", "json", "verbose")
def apply(name: str) -> None:
    """Use a saved set for all pointing: write it into [alignment] of birdcage.toml.

    A birdcage that runs takes it at its next start, or when the app's own calibration applies it.
    """
    from birdcage.base.alignments import alignment_settings
    from birdcage.base.config import edit
    from birdcage.calibration.work import in_force
    from birdcage.cli.say import say

    paths = find_paths()
    entry = _named(paths.alignments_file, name)
    edit(paths.config_file, alignment_settings(entry))
    words = in_force(load_settings(paths)).words() or "all zero"
    say(f"In force: {entry.name}: {words}.")


@command.command("remove", epilog=DATA_EPILOG)
@click.argument("numbers", nargs=-1, type=click.IntRange(min=1), metavar="[PEAK]...")
@click.option("--all", "every", is_flag=True, help="Delete all peaks: the base was moved.")
@click.option("--set", "name", metavar="NAME", help="Delete a set. If it is in use, its terms stay in use.")
@global_options("config", "json", "verbose")
def remove(numbers: tuple[int, ...], every: bool, name: str | None) -> None:
    """Delete peaks by number, or a set by name."""
    from birdcage.base.alignments import remove_set
    from birdcage.calibration.peaks_file import load_peaks, peaks_file, remove_peaks
    from birdcage.cli.say import say

    if bool(numbers) + every + (name is not None) != 1:
        raise click.UsageError("Name peaks by their numbers, or give --all, or --set NAME.")
    paths = find_paths()
    if name is not None:
        remove_set(paths.alignments_file, _named(paths.alignments_file, name).name)
        say(f"{name} is forgotten.")
        return
    count = len(load_peaks(peaks_file(paths)).entries)
    left = len(remove_peaks(peaks_file(paths), *numbers).entries)
    say(f"{count - left} forgotten, {left} left.")


@command.command("next", short_help="Suggest what to peak on next.", epilog=DATA_EPILOG)
@at_option("When.")
@click.option("--all", "every", is_flag=True, help=f"All that is up and in reach, not the best {SHOWN} alone.")
@global_options("firmware", "json", "config", "verbose", firmware=NO_DISH)
def next_(at: datetime | None, every: bool) -> None:
    """Name what to peak on next: what makes the pointing known best over the whole sky.

    Sun, Moon and geostationary places that are up, in reach and not known to be beyond the feed's hearing. RISE is the
    signal to expect. FOUND TO is how well a person finds its middle. SKY THEN is the error to expect over the whole
    sky afterwards. Elevations include refraction, as `tracking.refraction` sets it. No dish is needed.
    """
    from datetime import UTC, datetime

    from birdcage.calibration.next_best import enough
    from birdcage.calibration.peaks_file import load_peaks, peaks_file
    from birdcage.calibration.work import fit_for, proposals_for
    from birdcage.cli.calibrate_words import ENOUGH, proposal_values, tell_proposals
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.standing import limits_of

    dish = wanted()
    peaks = load_peaks(peaks_file(dish.paths))
    for problem in peaks.problems:
        say(problem)
    fitted = fit_for(dish.settings, peaks.entries)
    found = proposals_for(dish.settings, peaks.entries, at or datetime.now(UTC), limits_of(dish), fitted, dish.beam)
    shown = found if every else found[:SHOWN]
    refraction = dish.settings.tracking.refraction
    if flags().json:
        tell_json([proposal_values(each, refraction) for each in shown])
        return
    if not found:
        say("This feed can hear nothing in reach now that has no peak yet.")
        return
    tell_proposals(shown)
    say(f"Elevations include refraction ({refraction})." if refraction != "none" else "No refraction is included.")
    say(ENOUGH if enough(found) else f"Best: {found[0].candidate.name} {found[0].words()}.")


@command.command("add", short_help="Take a peak.", epilog=EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1, required=True)
@click.option("--dish-az", "dish_az_deg", type=click.FloatRange(-720.0, 720.0), metavar="DEG",
              help="What the dish read, in its own degrees.  [default: the dish is asked]")  # fmt: skip
@click.option("--dish-el", "dish_el_deg", type=click.FloatRange(-90.0, 180.0), metavar="DEG", help="The same.")
@at_option("When that was.")
@click.option("--sigma", "sigma_deg", type=click.FloatRange(0.001, 45.0), metavar="DEG",
              help="How well it was peaked.  [default: by the signal to expect]")  # fmt: skip
@global_options()
def add(
    target: tuple[str, ...], dish_az_deg: float | None, dish_el_deg: float | None, at: datetime | None,
    sigma_deg: float | None,
) -> None:  # fmt: skip
    """Take a peak: the dish is on TARGET now, or was with these readings.

    TARGET is named as for `birdcage where`. The dish does not move.
    """
    from birdcage.calibration.peaks_file import add_peak, peaks_file
    from birdcage.calibration.work import peak_at
    from birdcage.cli.calibrate_words import peak_values
    from birdcage.cli.named_target import find_target
    from birdcage.cli.say import say, tell_json

    no_options_among(target)
    if (dish_az_deg is None) != (dish_el_deg is None):
        raise click.UsageError("--dish-az and --dish-el go together.")
    if at is not None and dish_az_deg is None:
        raise click.UsageError("--at goes with --dish-az and --dish-el: the dish tells where it is now.")
    dish = wanted()
    meant = find_target(target, dish.paths, None, say).target
    if dish_az_deg is not None and dish_el_deg is not None:
        position = _typed(dish_az_deg, dish_el_deg, at)
    else:
        position = _asked(dish)
    peak = add_peak(peaks_file(dish.paths), peak_at(dish.settings, meant, position, sigma_deg, dish.beam))
    if flags().json:
        tell_json(peak_values(peak))
    else:
        say(
            f"Peak {peak.number}: {peak.target} at {peak.true_az_deg:.2f}° / {peak.true_el_deg:.2f}°, the dish at "
            f"{peak.dish_az_deg:.2f}° / {peak.dish_el_deg:.2f}°, good to {peak.sigma_deg:.2f}°."
        )
    if peak.true_el_deg <= 0.0:
        say(f"{peak.target} stands below the horizon at that time: `birdcage calibrate remove {peak.number}`.")


@command.command("guide", short_help="Guide you through all of it, at the dish.", epilog=EPILOG)
@global_options()
def guide() -> None:
    """Be led: it names the next object and goes there; you nudge until the meter is highest, and say so.

    Every peak is saved at once. Ctrl+C stops the dish.
    """
    from birdcage.calibration.guide import Guide
    from birdcage.calibration.work import observer_of
    from birdcage.cli.calibrate_talk import CalibrateTalk
    from birdcage.cli.dish import open_dish
    from birdcage.cli.talk import TypedLines

    if not sys.stdin.isatty():
        raise click.UsageError("The guide needs a terminal to ask its questions.")
    dish_wanted = wanted()
    observer_of(dish_wanted.settings)  # without a place there is nothing to begin with
    given = flags()
    over = {f"dish.{name}": given.get(name) for name in ("port", "firmware", "baud")}
    with open_dish(dish_wanted, moves=True) as dish:
        dish.come_up(15.0)
        dish.survey()
        leading = Guide(dish.session, dish_wanted.settings, dish_wanted.paths, flags=over, holder=HOLDER)
        try:
            CalibrateTalk(leading, dish, TypedLines(sys.stdin), dish_wanted.paths).run()
        finally:
            leading.close()


def _typed(az_deg: float, el_deg: float, at: datetime | None) -> Pointing:
    from datetime import UTC, datetime

    from birdcage.station.state import Pointing

    return Pointing(az_deg, el_deg, az_deg, el_deg, 0.0, at or datetime.now(UTC))


def _asked(wanted: Wanted) -> Pointing:
    from birdcage.base.errors import PositionUnknown
    from birdcage.cli.dish import how_to_home, open_dish

    with open_dish(wanted, survey=False) as dish:
        state = dish.come_up(15.0)
    if state.position is None or state.position_lost is not None:
        raise PositionUnknown(
            f"The dish does not know where it points, so the peak is not taken. {how_to_home(state)}",
            reason=Reason.UNHOMED,
        )
    return state.position


def _read_peaks(dish: Wanted) -> Peaks:
    from birdcage.calibration.peaks_file import load_peaks, peaks_file
    from birdcage.cli.say import say

    peaks = load_peaks(peaks_file(dish.paths))
    for problem in peaks.problems:
        say(problem)
    return peaks


def _named(file: Path, name: str) -> AlignmentSet:
    from birdcage.base.alignments import load_sets
    from birdcage.base.errors import ConfigError

    sets = load_sets(file)
    entry = sets.named(name)
    if entry is None:
        known = ", ".join(each.name for each in sets.entries)
        raise ConfigError(
            f"There is no set called {name!r}: " + (f"there are {known}." if known else "none was kept yet.")
        )
    return entry
