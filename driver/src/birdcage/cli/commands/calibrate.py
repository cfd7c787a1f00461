"""`birdcage calibrate`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.commands.calibrate_add import add
from birdcage.cli.commands.calibrate_guide import guide
from birdcage.cli.commands.calibrate_next import next_
from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import find_paths, flags, global_options, load_settings, wanted

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.alignments import AlignmentSet
    from birdcage.calibration.fit import Fit
    from birdcage.calibration.peaks_file import Peaks
    from birdcage.cli.options import Wanted


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


for each in (next_, add, guide):
    command.add_command(each)
