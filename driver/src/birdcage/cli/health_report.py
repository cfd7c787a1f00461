"""A dish's health as lines for people, and as values for JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.cli.say import iso, tell
from birdcage.cli.table import tell_table
from birdcage.diagnostics.finding import Weight
from birdcage.diagnostics.wording import share
from birdcage.station.state import TvSearch

if TYPE_CHECKING:
    from birdcage.diagnostics.figures import HealthFigures, LinkFigures, MotorFigures
    from birdcage.diagnostics.finding import Finding
    from birdcage.diagnostics.health import DishHealth
    from birdcage.rotator.feature import Reading

GLYPHS = {Weight.FAULT: "✗", Weight.WARN: "!", Weight.NOTE: "·"}
HEAD = ("MOTOR", "STALLS", "DRIVER", "MOVES", "TURNS", "BEFORE", "IN ALL")


def tell_health(health: DishHealth) -> None:
    """Print the findings, the most urgent first, what was looked at, and the figures."""
    for each in health.findings:
        _tell_finding(each)
    if not health.findings:
        tell(f"✓ {health.headline}")
    tell(health.looked_at)
    figures = health.figures
    if figures.motors:
        tell(f"\nmotors, {figures.days} days; turns before: in the {figures.days} days before them")
        tell_table(HEAD, [_motor(each) for each in figures.motors], " r rrrr")
    tell(f"\nlink and power, {figures.days} days")
    for name, value in _link_rows(figures.link):
        tell(f"{name:12} {value}")


def _tell_finding(finding: Finding) -> None:
    tell(f"{GLYPHS[finding.weight]} {finding.text}")
    tell(f"  {finding.why}")
    for step in finding.todo:
        tell(f"  → {step}")
    if not finding.lasts:
        tell(f"  seen it: birdcage health --acknowledge {finding.id}")


def _motor(motor: MotorFigures) -> tuple[str, ...]:
    return (
        motor.axis, str(motor.stalls), _reading(motor.driver), f"{motor.moves:,}", f"{motor.turns:,.1f}",
        f"{motor.turns_before:,.1f}", "-" if motor.turns_in_all is None else f"{motor.turns_in_all:,.1f}",
    )  # fmt: skip


def _link_rows(link: LinkFigures) -> list[tuple[str, str]]:
    last = "" if link.last_restart is None else f", the last {link.last_restart.utc:%Y-%m-%d %H:%M} UTC"
    trip = "" if link.round_trip_s is None else f", {link.round_trip_s * 1000.0:.0f} ms"
    late = f", {link.late:,} late" if link.late else ""
    noise = f", {link.stray_bytes:,} bytes of noise" if link.stray_bytes else ""
    homed = {True: "yes", False: "no", None: "-"}[link.homed]
    return [
        ("replies", f"lost {share(link.unanswered, link.asked)}{late}{noise}{trip}" if link.asked else f"-{trip}"),
        ("restarts", f"{link.restarts}{last}"),
        ("silences", str(link.silences)),
        ("port lost", str(link.port_losses)),
        ("homed", homed),
        ("TV search", "-" if link.search is TvSearch.UNKNOWN else link.search.value),
        ("LNB", _reading(link.lnb_supply)),
    ]


def _reading(reading: Reading | None) -> str:
    if reading is None:
        return "-"
    value = f"{reading.value:.1f}" if isinstance(reading.value, float) else str(reading.value)
    return f"{value} {reading.unit}".strip()


def health_values(health: DishHealth) -> dict[str, object]:
    """Return all of it for JSON; what is not known is null."""
    return {
        "dish": health.dish or None,
        "needs_you": health.needs_you,
        "findings": [_finding_values(each) for each in health.findings],
        "looked_at": health.looked_at,
        **_figure_values(health.figures),
    }


def _finding_values(finding: Finding) -> dict[str, object]:
    return {
        "id": finding.id,
        "weight": finding.weight.value,
        "text": finding.text,
        "why": finding.why,
        "todo": list(finding.todo),
        "since": iso(finding.since),
        "latest": iso(finding.latest),
        "count": finding.count,
        "can_be_acknowledged": not finding.lasts,
    }


def _figure_values(figures: HealthFigures) -> dict[str, object]:
    link = figures.link
    return {
        "days": figures.days,
        "motors": [
            {
                "axis": each.axis,
                "stalls": each.stalls,
                "driver": None if each.driver is None else each.driver.value,
                "driver_is_good": each.driver_is_good,
                "moves": each.moves,
                "turns": round(each.turns, 2),
                "turns_before": round(each.turns_before, 2),
                "turns_in_all": None if each.turns_in_all is None else round(each.turns_in_all, 2),
                "counted_since": iso(each.counted_since),
            }
            for each in figures.motors
        ],
        "link": {
            "round_trip_s": link.round_trip_s,
            "asked": link.asked,
            "unanswered": link.unanswered,
            "late": link.late,
            "stray_bytes": link.stray_bytes,
            "restarts": link.restarts,
            "last_restart": None if link.last_restart is None else iso(link.last_restart.utc),
            "silences": link.silences,
            "port_losses": link.port_losses,
            "homed": link.homed,
            "search": None if link.search is TvSearch.UNKNOWN else link.search.value,
            "lnb_supply_v": None if link.lnb_supply is None else link.lnb_supply.value,
        },
    }
