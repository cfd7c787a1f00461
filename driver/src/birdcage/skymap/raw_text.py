"""A map as the raw text of the sky-scan programs that people have: lines of the G2's, matrices of the others.

Formats: `docs/reference/sky-scans.md`. Both kinds of readers skip a line that begins with #, so DEMO stands there.
"""

from __future__ import annotations

from collections.abc import Iterable

from birdcage.signal.recordings import DEMO
from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sky_map import SkyMap

UNREAD = -1
"""What stands for a direction that was not heard, in lines; in a matrix it is 0."""
UNKNOWN = -1.0
"""Gain or bias tee in the settings of a matrix, where they are not known."""


class NotInThisForm(ValueError):
    """A map can't be told in a form; the message is a sentence that says why."""


def as_lines(sky_map: SkyMap) -> bytes:
    """Return it as `az el value`, azimuth outside, both rising. NotInThisForm where a value would read as unread."""
    _check_frame(sky_map)
    heard = {sample.cell: sample.value for sample in sky_map.samples}
    if sky_map.decibels or min(heard.values(), default=0.0) < 0.0:
        raise NotInThisForm("No lines of winegard-sky-scan: they hold counts from 0 up only.")
    plan = sky_map.plan
    cells = (row * plan.columns + column for column in range(plan.columns) for row in range(plan.rows))
    lines = (f"{plan.at(cell)[0]} {plan.at(cell)[1]} {_number(heard.get(cell, UNREAD))}" for cell in cells)
    return _text(sky_map, lines)


def as_matrix(sky_map: SkyMap) -> tuple[bytes, bytes]:
    """Return a matrix and its settings: of decibels as Carryout-Radio-Telescope writes it, else as the Tailgater's.

    NotInThisForm where the grid has other steps than whole degrees, or decibels come without their frequency.
    """
    import numpy as np

    _check_frame(sky_map)
    plan = sky_map.plan
    whole = all(each == round(each) for each in (plan.x_low_deg, plan.y_low_deg))
    if not whole or plan.step_deg != 1.0 or plan.row_step_deg != 1.0:
        step_deg = plan.step_deg if plan.step_deg != 1.0 else plan.row_step_deg
        raise NotInThisForm(f"No matrix of raw text: it has whole degrees, and this map steps of {step_deg:g}°.")
    grid = np.nan_to_num(sky_map.grid()[::-1], nan=0.0)
    az, el = round(plan.x_low_deg), round(plan.y_low_deg)
    az_end, el_end = az + plan.columns - 1, el + plan.rows - 1
    if sky_map.decibels:
        settings = dict(sky_map.settings[0])
        freq_hz = _told(settings, "freq_hz") or sky_map.about.get("freq_hz")
        if not isinstance(freq_hz, int | float):
            raise NotInThisForm("No matrix of raw text: one in dB tells its frequency, which is not known here.")
        tuned = (freq_hz / 1e6, _told(settings, "bias_tee", UNKNOWN), _told(settings, "gain_db", UNKNOWN))
        matrix = np.hstack([np.zeros((plan.rows, 1)), grid])  # that program never fills its first column
        numbers: tuple[float | None, ...] = (az, az_end + 1, el, el_end, 1, *tuned)
    else:
        matrix, numbers = grid[:, ::-1], (az, az_end, el, el_end, 1)
    rows = (" ".join(f"{value:.18e}" for value in row) for row in matrix)
    return _text(sky_map, rows), _text(sky_map, (f"{number:.18e}" for number in numbers))


def _check_frame(sky_map: SkyMap) -> None:
    if sky_map.plan.frame is MapFrame.TARGET:
        raise NotInThisForm("No raw text: it has no form for a map around a target.")


def _told(settings: dict[str, str], name: str, otherwise: float | None = None) -> float | None:
    try:
        return float(settings[name])
    except (KeyError, ValueError):
        return otherwise


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) else f"{value:.10g}"


def _text(sky_map: SkyMap, lines: Iterable[str]) -> bytes:
    head = (f"# {DEMO}",) if sky_map.demo else ()
    return "".join(f"{line}\n" for line in (*head, *lines)).encode("ascii")
