"""The log of passes as tables for people, and as values for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.cli.heard_report import tell_files, tell_heard, values_of_files, values_of_heard
from birdcage.cli.pass_table import minutes
from birdcage.cli.say import iso, say, tell
from birdcage.cli.table import tell_table
from birdcage.pursuit.pass_book import worst_moments

if TYPE_CHECKING:
    from birdcage.pursuit.pass_book import PassRecord, Total
    from birdcage.pursuit.pass_record import MadeFile, PassHead, PassSample, Remark

HEAD = ("NO", "BEGAN (UTC)", "TARGET", "BEST", "FOLLOWED", "RMS", "MAX", "0.5 dB", "BY", "HOW IT ENDED")
CUT_OFF = "Under way, or cut off in mid-pass."
DEMO = "DEMO "


def tell_passes(records: Sequence[PassRecord], total: Total) -> None:
    """Print a line a pass, and what all come to."""
    tell_table(HEAD, [_cells(each) for each in records], "r  rrrrr")
    if total.rms_deg is None:
        say(f"{_passes(total.passes)}, none with samples.")
        return
    say(
        f"{_passes(total.passes)}, {minutes(total.followed_s)} followed: RMS {_degrees(total.rms_deg)}, at most "
        f"{_degrees(total.max_error_deg)}, within 0.5 dB {_share(total.within_share)} of the time."
    )
    if any(each.head.demo for each in records):
        say("What is marked DEMO was a simulated dish.")


def tell_pass(
    record: PassRecord, samples: Sequence[PassSample], remarks: Sequence[Remark], files: Sequence[MadeFile]
) -> None:  # fmt: skip
    """Print all that is known of one pass: what was heard, its worst moments, what hooks made and printed."""
    head = record.head
    if head.demo:
        tell("DEMO: a simulated dish, not a real one.")
    number = "" if head.norad_id is None else f" ({head.norad_id})"
    rows = (
        ("target", f"{head.name}{number}"),
        ("site", head.site or "-"),
        ("AOS, LOS", f"{_clock(head.aos)}, {_clock(head.los)}"),
        ("reach", _reach(head)),
        ("began", f"{head.started:%Y-%m-%d %H:%M:%S}"),
        ("ended", _clock(record.ended)),
        ("how", record.outcome or CUT_OFF),
        ("controller", head.controller or "-"),
        ("latency", "-" if head.latency_s is None else f"{head.latency_s * 1000:.0f} ms"),
        ("elements of", "-" if head.elements_epoch is None else f"{head.elements_epoch:%Y-%m-%d %H:%M} UTC"),
        ("time offset", f"{head.time_offset_s:+g} s"),
        ("samples", str(record.samples)),
        ("dish error", f"RMS {_degrees(record.rms_deg)}, at most {_degrees(record.max_error_deg)}"),
        ("dish forecast", f"RMS {_degrees(head.forecast_rms_deg)}, at most {_degrees(head.forecast_max_deg)}"),
        ("within 0.5 dB", _share(record.within_share)),
        ("file", "-" if record.csv is None else str(record.csv)),
    )
    for name, value in rows:
        tell(f"{name:14} {value}")
    tell_heard(samples)
    tell_files(files)
    worst = worst_moments(samples)
    if worst:
        tell("\nworst moments")
        tell_table(
            ("UTC", "ERROR", "LOSS", "TARGET", "COMMANDED", "REPORTED", "SIGNAL"), [_moment(each) for each in worst]
        )
    if remarks:
        tell("\nremarks")
        for each in remarks:
            tell(f"{each.utc:%H:%M:%S}  {each.text}")


def values_of_record(record: PassRecord) -> dict[str, object]:
    """Return one pass for JSON, without its samples; what is not known is null."""
    head = {name: _value(value) for name, value in asdict(record.head).items()}
    return {
        "number": record.number,
        **head,
        "ended": iso(record.ended),
        "outcome": record.outcome,
        "csv": None if record.csv is None else str(record.csv),
        "samples": record.samples,
        "followed_s": _value(record.followed_s),
        "rms_deg": _value(record.rms_deg),
        "max_error_deg": _value(record.max_error_deg),
        "within_half_db_share": _value(record.within_share),
    }


def values_of_pass(
    record: PassRecord, samples: Sequence[PassSample], remarks: Sequence[Remark], files: Sequence[MadeFile]
) -> dict[str, object]:  # fmt: skip
    """Return one pass for JSON, with what was heard, its worst moments, every sample, the remarks and the files."""
    return {
        **values_of_record(record),
        "worst": [_values(asdict(each)) for each in worst_moments(samples)],
        "all_samples": [_values(asdict(each)) for each in samples],
        "remarks": [_values(asdict(each)) for each in remarks],
        **values_of_heard(samples),
        "files": values_of_files(files),
    }


def values_of_total(total: Total) -> dict[str, object]:
    """Return what passes come to, for JSON."""
    return {
        "passes": total.passes,
        "followed_s": _value(total.followed_s),
        "rms_deg": _value(total.rms_deg),
        "max_error_deg": _value(total.max_error_deg),
        "within_half_db_share": _value(total.within_share),
    }


def _cells(record: PassRecord) -> tuple[str, ...]:
    head = record.head
    return (
        str(record.number),
        f"{head.started:%Y-%m-%d %H:%M:%S}",
        f"{DEMO if head.demo and not head.name.startswith(DEMO) else ''}{head.name}",
        _degrees(head.max_el_deg, 1),
        "-" if record.followed_s is None else minutes(record.followed_s),
        _degrees(record.rms_deg),
        _degrees(record.max_error_deg),
        _share(record.within_share),
        head.controller or "-",
        record.outcome or CUT_OFF,
    )


def _moment(sample: PassSample) -> tuple[str, ...]:
    return (
        f"{sample.utc:%H:%M:%S}",
        _degrees(sample.error_deg),
        "-" if sample.loss_db is None else f"{sample.loss_db:.1f} dB",
        _direction(sample.target_az_deg, sample.target_el_deg),
        _direction(sample.commanded_az_deg, sample.commanded_el_deg),
        _direction(sample.reported_az_deg, sample.reported_el_deg),
        "-" if sample.signal is None else f"{sample.signal:.6g} {sample.unit or ''}".strip(),
    )


def _direction(az_deg: float, el_deg: float) -> str:
    return f"{az_deg % 360.0:.2f}° {el_deg:.2f}°"


def _degrees(value: float | None, digits: int = 3) -> str:
    return "-" if value is None else f"{value:.{digits}f}°"


def _share(value: float | None) -> str:
    # Not rounded up: 100 % is all of it.
    return "-" if value is None else f"{int(value * 1000.0) / 10.0:.1f} %"


def _reach(head: PassHead) -> str:
    """Return when it was in reach; without an end for what is always up."""
    start = _clock(head.reach_start)
    span = f"from {start} on" if head.reach_start and head.reach_end is None else f"{start} to {_clock(head.reach_end)}"
    return f"{span}, up to {_degrees(head.max_el_deg, 1)}"


def _clock(moment: datetime | None) -> str:
    return "-" if moment is None else f"{moment:%H:%M:%S}"


def _passes(count: int) -> str:
    return f"{count} {'pass' if count == 1 else 'passes'}"


def _values(values: dict[str, object]) -> dict[str, object]:
    return {name: _value(value) for name, value in values.items()}


def _value(value: object) -> object:
    if isinstance(value, datetime):
        return iso(value)
    return round(value, 6) if isinstance(value, float) else value
