"""Follows passes with the kin of the Carryout G2, by the whole station: each by what it shows of itself."""

from __future__ import annotations

from collections.abc import Sequence
from multiprocessing.pool import Pool
from statistics import median

from tracking_passes import Case
from tracking_station import Attempt, Told, attempt

IDEAL = "overshoot=0&backlash=0"
ROWS = {
    "g2plus": ("Carryout G2+, tells its position", "g2plus", f"bare_a=angles&{IDEAL}"),
    "g2plus_untold": ("Carryout G2+, does not tell", "g2plus", f"bare_a=error&{IDEAL}"),
    "pathway_x1": ("Pathway X1, does not tell", "pathway-x1", f"bare_a=nothing&{IDEAL}"),
    "pathway_x2": ("Pathway X2, waits up to 15 s", "pathway-x2", IDEAL),
}
"""By key of the report: what is printed, the firmware, and what is taken of the dish."""
LINES = 2
"""The commands of one direction."""


def way_of_a_command_deg(told: Told) -> float:
    """Return how far the target goes between two commands: what a dish that is not read cannot undercut for long."""
    return told.rate_deg_s * told.seconds * LINES / max(told.commands, 1)


def kin_rows(cases: Sequence[Case], pool: Pool) -> dict[str, float]:
    """Follow passes with each, print a row for each, and return what they come to.

    The X2 is shown and has no goal: what it does with its wait is chance.
    """
    head = f"{'rms':>8}{'worst':>9}{'foreseen':>10}{'a command':>11}{'commands':>10}"
    print(f"\nKin of the G2, whole station       {head}")
    found: dict[str, float] = {}
    for key, (title, firmware, options) in ROWS.items():
        works = [Attempt(case, options, firmware) for case in cases]
        told = [each for each in pool.imap(attempt, works, chunksize=1) if each is not None]
        rms, ways = median(each.rms for each in told), median(map(way_of_a_command_deg, told))
        foreseen, sent = median(each.foreseen_rms for each in told), median(each.commands for each in told)
        print(f"{title:34}{rms:8.3f}{max(each.rms for each in told):9.3f}{foreseen:10.3f}{ways:11.3f}{sent:10.0f}")
        found |= {f"{key}_median_rms_deg": rms, f"{key}_worst_rms_deg": max(each.rms for each in told)}
        if key != "pathway_x2":
            found[f"{key}_ratio_to_a_command"] = rms / ways
    return found
