"""What the Calibrate tab says in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap

if TYPE_CHECKING:
    from birdcage.calibration.fit import Fit
    from birdcage.calibration.guide import GuideView

ENOUGH = "More peaks add little now. a: use the fit. Add more when the Sun is elsewhere."
WHY = (
    "A dish set up by hand points some degrees off, by different amounts over the sky. Peaks on known objects show how "
    "its base is turned, how it leans, and where the beam looks."
)
HOW = "n selects the next best object, Enter goes there. f finds its peak by the signal and saves it."
THEN = (
    "Two objects give the offsets, three the tilt, four or more the collimation. Then press a to save the fit and use "
    "it for all pointing."
)
BEGIN = (("strong", "Measure the alignment of the dish"), ("text", WHY), ("text", HOW), ("dim", THEN))
TERMS = (
    ("az_offset_deg", "azimuth offset"),
    ("el_offset_deg", "elevation offset"),
    ("ca_deg", "beam looks left"),
    ("an_deg", "axis leans north"),
    ("aw_deg", "axis leans west"),
)
FAIR, POOR = 30.0, 100.0
"""Condition numbers: the geostationary arc alone comes to some 60; beyond 100 the fit itself warns."""
CLOSE_DEG = 0.005


def direction(az_deg: float, el_deg: float, digits: int = 2) -> str:
    """Return azimuth and elevation in columns."""
    return f"{az_deg:{4 + digits}.{digits}f}° {el_deg:{3 + digits}.{digits}f}°"


def aside(right_deg: float, up_deg: float) -> str:
    """Return an offset on the sky in words: `0.42° right, 0.10° up`."""
    parts = [
        f"{abs(value):.2f}° {positive if value > 0 else negative}"
        for value, positive, negative in ((right_deg, "right", "left"), (up_deg, "up", "down"))
        if abs(value) >= CLOSE_DEG
    ]
    return ", ".join(parts) or "not at all"


def maybe(value: float | None, digits: int = 2) -> str:
    """Return an angle; a dash for an unknown one."""
    return "--" if value is None else f"{value:.{digits}f}°"


def fitted_words(fit: Fit) -> str:
    """Say what was fitted to how much."""
    count = len(fit.residuals)
    what = {2: "offsets", 4: "offsets, tilt"}.get(len(fit.terms), "offsets, tilt, beam")
    return f"{count} peak{'' if count == 1 else 's'}: {what}"


def condition_words(fit: Fit) -> tuple[str, str]:
    """Return ink and words for how well the peaks tell the terms apart."""
    value = fit.condition
    if value is None:
        return "warn", "-- undetermined"
    if value > POOR:
        return "warn", f"{value:.0f} poorly spread"
    return ("text", f"{value:.0f} fairly spread") if value > FAIR else ("good", f"{value:.0f} well spread")


def figure_rows(guide: GuideView, *, short: bool) -> list[tuple[str, str, str]]:
    """Return (label, ink, words) of how good the fit is; dashes where nothing is known. `short`: in three rows."""
    fit = guide.fit
    if fit is None:
        return []
    ink, words = condition_words(fit)
    sky = guide.sky_error_deg
    if len(fit.residuals) == 1:  # one peak fits itself
        return [("RMS", "text", f"{maybe(fit.rms_before_deg)} before"), ("whole sky", "text", f"{maybe(sky)} expected"),
                ("one peak", "dim", "nothing to judge yet")]  # fmt: skip
    if short:
        return [
            ("RMS", "text", f"{maybe(fit.rms_before_deg)} → {maybe(fit.rms_deg)}"),
            ("left out", "text", f"{maybe(fit.leave_one_out_rms_deg)}, sky {maybe(sky)}"),
            ("condition", ink, words),
        ]
    return [
        ("fitted to", "text", fitted_words(fit)),
        ("RMS", "text", f"{maybe(fit.rms_before_deg)} before, {maybe(fit.rms_deg)} after"),
        ("left out", "text", f"{maybe(fit.leave_one_out_rms_deg)} RMS"),
        ("whole sky", "text", f"{maybe(sky)} expected"),
        ("condition", ink, words),
    ]


def put_wrapped(cells: Cells, y: int, words: str, ink: str, *, x: int = 1, width: int | None = None,
                rows: int | None = None) -> int:  # fmt: skip
    """Write words in as many rows as they need and there are; return the row after them."""
    room = cells.height - y if rows is None else min(rows, cells.height - y)
    if room <= 0 or not words:
        return y
    wide = max((cells.width - x - 1) if width is None else width, 10)
    for line in wrap(words, wide, most=room):
        cells.put(x, y, line, ink)
        y += 1
    return y
