"""What `birdcage calibrate` prints: a fit, its residuals, peaks, sets and proposals, for people and for programs."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from birdcage.base.alignments import TERMS
from birdcage.cli.say import iso, tell
from birdcage.cli.table import tell_table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.base.alignments import AlignmentSet
    from birdcage.calibration.fit import Fit
    from birdcage.calibration.next_best import Proposal
    from birdcage.calibration.peak import MeasuredPeak

MEANING = {
    "az_offset_deg": ("-IA", "azimuth offset"),
    "el_offset_deg": ("IE", "elevation offset"),
    "ca_deg": ("CA", "beam to the left"),
    "an_deg": ("AN", "axis leans north"),
    "aw_deg": ("AW", "axis leans west"),
}
ENOUGH = "More peaks add little now. Use the fit, and add more when the Sun is elsewhere."
PLOT_ROWS, PLOT_COLUMNS = 11, 43
"""Odd: the middle is where a perfect peak lies."""
NICE_DEG = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)


def peak_values(peak: MeasuredPeak) -> dict[str, object]:
    """Return a peak for JSON."""
    return {**asdict(peak), "utc": iso(peak.utc), **_rounded(peak, "true_az_deg", "true_el_deg", "sigma_deg")}


def tell_peaks(peaks: Sequence[MeasuredPeak]) -> None:
    """Print the peaks as a table."""
    rows = [
        [str(each.number), f"{each.utc:%Y-%m-%d %H:%MZ}", each.target, f"{each.true_az_deg:.2f}",
         f"{each.true_el_deg:.2f}", f"{each.dish_az_deg:.2f}", f"{each.dish_el_deg:.2f}", f"{each.sigma_deg:.2f}",
         each.found]
        for each in peaks
    ]  # fmt: skip
    tell_table(["NO", "TAKEN", "OBJECT", "AZ", "EL", "DISH AZ", "DISH EL", "±", "BY"], rows, "r  rrrrr")


def fit_values(fit: Fit, sky_error_deg: float) -> dict[str, object]:
    """Return a fit for JSON. Residuals are on the sky: how far the object lay right of and above the modelled beam."""
    return {
        "terms_deg": {term: round(getattr(fit.alignment, term), 4) for term in TERMS},
        "fitted": list(fit.terms),
        "errors_deg": {
            term: None if error is None else round(error, 4) for term, error in zip(TERMS, fit.errors_deg, strict=True)
        },
        "rms_before_deg": round(fit.rms_before_deg, 4),
        "rms_deg": round(fit.rms_deg, 4),
        "leave_one_out_rms_deg": _maybe(fit.leave_one_out_rms_deg, 4),
        "sky_error_deg": round(sky_error_deg, 4),
        "condition": _maybe(fit.condition, 1),
        "warning": fit.warning or None,
        "residuals": [
            {"peak": each.peak.number, "target": each.peak.target, "right_deg": round(each.right_deg, 4),
             "up_deg": round(each.up_deg, 4), "alone_right_deg": _maybe(each.alone_right_deg, 4),
             "alone_up_deg": _maybe(each.alone_up_deg, 4)}
            for each in fit.residuals
        ],
    }  # fmt: skip


def tell_fit(fit: Fit, sky_error_deg: float) -> None:
    """Print a fit: terms, how good it is, residuals, and a plot of these."""
    rows = []
    for term, error in zip(TERMS, fit.errors_deg, strict=True):
        symbol, meaning = MEANING[term]
        shown = "held" if error is None else f"±{error:.3f}"
        rows.append([symbol, meaning, f"{getattr(fit.alignment, term):+.3f}", shown])
    tell_table(["TERM", "WHAT", "DEG", ""], rows, "  rr")
    alone = "-" if fit.leave_one_out_rms_deg is None else f"{fit.leave_one_out_rms_deg:.3f}°"
    condition = "-" if fit.condition is None else f"{fit.condition:.0f}"
    tell("")
    tell(f"RMS {fit.rms_before_deg:.3f}° before, {fit.rms_deg:.3f}° after; leaving each out {alone}")
    tell(f"expected all over the sky that this dish reaches {sky_error_deg:.2f}°; condition {condition}")
    tell("")
    tell_table(
        ["NO", "OBJECT", "RIGHT", "UP", "OFF", "ALONE"],
        [[str(each.peak.number), each.peak.target, f"{each.right_deg:+.3f}", f"{each.up_deg:+.3f}",
          f"{each.off_deg:.3f}", _alone(each.alone_right_deg, each.alone_up_deg)] for each in fit.residuals],
        "r rrrr",
    )  # fmt: skip
    tell("")
    for line in residual_plot([(each.peak.number, each.right_deg, each.up_deg) for each in fit.residuals]):
        tell(line)


def residual_plot(points: Sequence[tuple[int, float, float]]) -> list[str]:
    """Return the residuals as a small picture: each peak's number where its object lay, right of and above the beam."""
    most = max((abs(value) for _number, right, up in points for value in (right, up)), default=0.0)
    reach = next((nice for nice in NICE_DEG if nice >= most), NICE_DEG[-1])
    middle_row, middle_column = PLOT_ROWS // 2, PLOT_COLUMNS // 2
    cells = [[" "] * PLOT_COLUMNS for _ in range(PLOT_ROWS)]
    cells[middle_row] = ["-"] * PLOT_COLUMNS
    for row in cells:
        row[middle_column] = "|"
    cells[middle_row][middle_column] = "+"
    for number, right, up in points:
        row_at = middle_row - round(up / reach * middle_row)
        text = str(number)
        start = min(middle_column + round(right / reach * middle_column), PLOT_COLUMNS - len(text))
        cells[row_at][start : start + len(text)] = text
    edge = f"{reach:g}°"
    lines = [f"{f'up {edge}' if index == 0 else '':>8} {''.join(row)}".rstrip() for index, row in enumerate(cells)]
    left = f"left {edge}"
    return [*lines, f"{'':8} {left}{f'right {edge}':>{PLOT_COLUMNS - len(left)}}"]


def proposal_values(proposal: Proposal, refraction: str) -> dict[str, object]:
    """Return a proposal for JSON; `refraction` is what lifts its elevation."""
    candidate = proposal.candidate
    return {
        "target": candidate.name,
        "azimuth_deg": round(candidate.az_deg, 3),
        "elevation_deg": round(candidate.el_deg, 3),
        "refraction": refraction,
        "rise_db": _maybe(candidate.rise_db, 2),
        "sigma_deg": round(candidate.sigma_deg, 3),
        "error_now_deg": round(proposal.error_now_deg, 3),
        "error_then_deg": round(proposal.error_then_deg, 3),
    }


def tell_proposals(proposals: Sequence[Proposal]) -> None:
    """Print proposals as a table, best first."""
    from birdcage.sky.rise import rise_words

    rows = [
        [each.candidate.name, f"{each.candidate.az_deg:.1f}", f"{each.candidate.el_deg:.1f}",
         rise_words(each.candidate.rise_db), f"{each.candidate.sigma_deg:.2f}°", f"{each.error_then_deg:.2f}°"]
        for each in proposals
    ]  # fmt: skip
    tell_table(["OBJECT", "AZ", "EL", "RISE", "FOUND TO", "SKY THEN"], rows, " rrrrr")


def set_values(entry: AlignmentSet, *, in_force: bool) -> dict[str, object]:
    """Return a set with a name for JSON."""
    return {**asdict(entry), "made": entry.made or None, "in_force": in_force}


def tell_sets(sets: Sequence[tuple[AlignmentSet, bool]]) -> None:
    """Print the sets as a table; the one in force has a star."""
    rows = [
        ["*" if used else "", each.name, *(f"{getattr(each, term):+.3f}" for term in TERMS),
         "-" if each.rms_deg is None else f"{each.rms_deg:.3f}", "-" if each.peaks is None else str(each.peaks),
         each.made or "-"]
        for each, used in sets
    ]  # fmt: skip
    tell_table(["", "SET", "AZ", "EL", "CA", "AN", "AW", "RMS", "PEAKS", "MADE"], rows, "  rrrrrrr")


def _alone(right: float | None, up: float | None) -> str:
    return "-" if right is None or up is None else f"{(right**2 + up**2) ** 0.5:.3f}"


def _maybe(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)


def _rounded(peak: MeasuredPeak, *names: str) -> dict[str, object]:
    return {name: round(getattr(peak, name), 4) for name in names}
