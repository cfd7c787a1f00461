"""The station's state as plain values: what `birdcage status --json` and the control channel tell."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from birdcage.rotator.facts import CableTurn
from birdcage.station.gear_words import gear_values
from birdcage.station.network_state import NetworkState
from birdcage.station.state import Activity, BootLog, HeldState, LinkPhase, StationState, StopReport, TvSearch
from birdcage.station.stop_words import stop_line

Value = str | float | bool | None
Told = Value | Sequence["Told"] | Mapping[str, "Told"]


def status_report(state: StationState, now: float) -> dict[str, Told]:
    """Return the state as a dict that JSON can hold; what is not known is None.

    `now` is the station's monotonic time, from which ages in seconds are counted. Angles are true degrees, as read:
    a position that no longer holds is left out, and `position_lost` says why. A `modelled` one is computed, as nothing
    can be asked during a silent slew; its age counts from the last reading.
    """
    pointing = state.position if state.position_lost is None else None
    motion, held, dish = state.motion, state.held, state.dish
    return {
        "connected": state.link.state is LinkPhase.UP,
        "link": state.link.state.value,
        "link_detail": state.link.detail or None,
        "last_reply_age_s": _age(state.link.last_reply, now),
        "port": state.port or None,
        "demo": state.demo,
        "firmware": dish.firmware if dish else None,
        "firmware_version": state.firmware_version,
        "azimuth_deg": _rounded(pointing.az_deg) if pointing else None,
        "elevation_deg": _rounded(pointing.el_deg) if pointing else None,
        "skew_deg": _rounded(pointing.skew_deg) if pointing and pointing.skew_deg is not None else None,
        "modelled": pointing.modelled if pointing else None,
        "uncertainty_deg": _rounded(pointing.uncertainty_deg)
        if pointing and pointing.uncertainty_deg is not None
        else None,
        "age_s": _age(pointing.told_at, now) if pointing else None,
        "position_lost": state.position_lost,
        "target_azimuth_deg": _rounded(motion.to_az_deg) if motion else None,
        "target_elevation_deg": _rounded(motion.to_el_deg) if motion else None,
        "target_miss_deg": _rounded(state.target_miss_deg) if motion else None,
        "target_skew_deg": _rounded(motion.to_skew_deg) if motion and motion.to_skew_deg is not None else None,
        "homed": state.homed,
        "activity": None if state.activity is Activity.UNKNOWN else state.activity.value,
        "holder": state.holder,
        "held": held is not None,
        "held_by": held.by or None if held else None,
        "held_since": held.utc.isoformat(timespec="seconds") if held and held.utc else None,
        "held_reason": held.why if held else None,
        "held_trouble": state.held_trouble or (held.damage if held else "") or None,
        "fault": state.fault.what if state.fault else None,
        "boot_log": boot_log_report(state.boot_log) if state.boot_log else None,
        "not_now": state.not_now or None,
        "motion_refused_because": state.motion_refused_because or (dish.no_direction if dish else "") or None,
        "search": None if state.search is TvSearch.UNKNOWN else state.search.value,
        "turn_of_cable": None if state.turn is CableTurn.UNKNOWN else state.turn.value,
        "alignment": state.alignment.words() or None,
        "gear": gear_values(state.own),
        "cable_deg": _rounded(pointing.cable_deg) if pointing and pointing.cable_deg is not None else None,
        "stop_power_s": motion.stop_power_s if motion else None,
        "stop_means": motion.stop_means if motion else None,
        "rests_in_s": _left(motion.rests_at, now) if motion else None,
        "stop": stop_line(state, now),
        "last_stop": stop_report(state.last_stop) if state.last_stop else None,
        "network": network_report(state.network) if state.network else None,
        "warnings": list(state.warnings.values()) or None,
    }


def network_report(network: NetworkState) -> dict[str, Told]:
    """Return the server for network clients, and who they are; what was said between them is left out."""
    return {
        "address": network.address,
        "by": network.by or None,
        "read_only": network.read_only,
        "strict": network.strict,
        "turned_away": network.turned_away,
        "recognises": network.recognises,
        "recognises_why_not": network.recognises_why_not or None,
        "clients": [
            {
                "name": client.name,
                "program": client.program.value or None,
                "address": client.address,
                "role": client.role.value,
                "wants_azimuth_deg": client.wants_az_deg,
                "wants_elevation_deg": client.wants_el_deg,
                "last_command": client.last_command or None,
                "last_utc": client.last_utc.isoformat(timespec="seconds") if client.last_utc else None,
                "commands": client.commands,
                "errors": client.errors,
                "ignored": client.ignored,
                "why_ignored": client.why or None,
                "shut_out": client.shut_out,
                "follows": client.follows or None,
                "follow_error_deg": client.follow_error_deg,
                "steps_error_deg": client.steps_error_deg,
            }
            for client in network.clients
        ],
    }


def boot_log_report(log: BootLog) -> dict[str, Told]:
    """Return when the dish last started, and what it printed."""
    return {"utc": log.utc.isoformat(timespec="seconds"), "lines": list(log.lines)}


def stop_report(report: StopReport) -> dict[str, Value]:
    """Return what a STOP really did; `confirmed` is None while, or where, that is not known."""
    return {"by": report.by, "means": report.means, "confirmed": report.confirmed, "sentence": report.sentence}


def release_report(before: HeldState | None, after: StationState, problem: str) -> dict[str, Value]:
    """Return what a release did: who held it until then, who moves first, and what still keeps it from moving."""
    waits = problem or (f"A fault is not acknowledged yet: {after.fault.what}." if after.fault else "")
    return {
        "held": after.held is not None,
        "was": before.sentence if before else None,
        "next_holder": before.next_holder if before else None,
        "trouble": " ".join(filter(None, (waits, after.held_trouble))) or None,
    }


def _age(at: float | None, now: float) -> float | None:
    return None if at is None else round(max(0.0, now - at), 3)


def _left(at: float | None, now: float) -> float | None:
    return None if at is None else round(max(0.0, at - now), 3)


def _rounded(angle_deg: float) -> float:
    return round(angle_deg, 3)
