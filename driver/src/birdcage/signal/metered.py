"""From a profile in the settings to a source: which meter, and what its readings mean."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from birdcage.base.text import clean
from birdcage.signal.command_meter import CommandMeter, rtl_power_level
from birdcage.signal.http_meter import HttpMeter
from birdcage.signal.meter import Meter, MeterError, MeterReading, level_in
from birdcage.signal.meter_source import MeterSource
from birdcage.signal.rigctl_meter import RigctlMeter
from birdcage.signal.rtl_tcp_meter import DWELL_S, RtlTcpMeter, Tuned
from birdcage.signal.source import Scale, SignalFacts

if TYPE_CHECKING:
    from birdcage.base.clock import Clock
    from birdcage.base.config import Settings
    from birdcage.base.config.signals import SignalProfile
    from birdcage.station.access import StationAccess

LABELS = {"satdump": "SatDump", "sdrpp": "SDR++"}
"""As these programs call themselves; the others by their ids."""
LEAST_PAUSE_S = 2.0
SPAN_DB = 10.0


def metered_source(name: str, settings: Settings, clock: Clock, station: StationAccess) -> MeterSource:
    """Return the source that `[signal.NAME]` says. KeyError where there is none; what it lacks is its trouble."""
    profile = settings.signals[name]
    return MeterSource(_facts(name, profile), meter_of(name, settings, clock), clock, station)


def _facts(name: str, profile: SignalProfile) -> SignalFacts:
    every_s, dwell_s = profile.every_s, profile.dwell_s or None
    if profile.kind == "rtl_tcp":
        every_s, dwell_s = DWELL_S, DWELL_S
    elif profile.kind == "command" and not profile.ask:
        every_s = profile.dwell_s or profile.every_s
    log = profile.scale == "log"
    return SignalFacts(
        name, LABELS.get(name, name), profile.unit, Scale.LOG if log else Scale.LINEAR, 1.0 / every_s,
        max(LEAST_PAUSE_S, 3.0 * every_s), latency_s=None, dwell_s=dwell_s, decimals=1 if log else 3,
        span=SPAN_DB if log else 0.0, least=None, of_dish=False, demo=False,
        where=clean(profile.url or profile.address or profile.command or ""), set_to=_set_to(profile),
    )  # fmt: skip


def _set_to(profile: SignalProfile) -> tuple[tuple[str, str], ...]:
    """Return what the profile says, without what is not set."""
    told = ((each.name, getattr(profile, each.name)) for each in fields(profile))
    return tuple((name, clean(str(value))) for name, value in told if value not in (None, ""))


def meter_of(name: str, settings: Settings, clock: Clock) -> Meter:
    """Return what reads the source that `[signal.NAME]` says. KeyError where there is none."""
    profile = settings.signals[name]
    freq_hz = profile.freq_hz
    if freq_hz is None:
        feed = settings.active_feed
        freq_hz = None if feed.middle_hz is None else abs(feed.middle_hz - (feed.lo_hz or 0.0))
    no_frequency = f"signal.{name}.freq_hz is not set, and the feed has no band. Set one of them in birdcage.toml."
    if profile.kind == "http":
        assert profile.url is not None, "its complaints said so"
        assert profile.path is not None, "its complaints said so"
        return HttpMeter(profile.url, profile.path, clock, every_s=profile.every_s, dwell_s=profile.dwell_s)
    if profile.kind == "rigctl":
        assert profile.address is not None, "its complaints said so"
        return RigctlMeter(profile.address, clock, every_s=profile.every_s, dwell_s=profile.dwell_s)
    if profile.kind == "rtl_tcp":
        assert profile.address is not None, "its complaints said so"
        if freq_hz is None:
            return UnsetMeter(no_frequency)
        tuned = Tuned(freq_hz, profile.sample_rate_hz, profile.channel_hz, profile.gain_db)
        return RtlTcpMeter(profile.address, tuned, clock)
    assert profile.command is not None, "its complaints said so"
    command = profile.command
    if "_HZ" in command:
        if freq_hz is None:
            return UnsetMeter(no_frequency)
        command = _filled_in(command, freq_hz, profile.channel_hz)
    level_of = rtl_power_level if profile.prints == "rtl_power" else level_in
    ask_every_s = profile.every_s if profile.ask else None
    return CommandMeter(
        command, clock, ask_every_s=ask_every_s, dwell_s=profile.dwell_s, level_of=level_of,
        patience_s=_facts(name, profile).pause_s,
    )  # fmt: skip


def _filled_in(command: str, freq_hz: float, channel_hz: float) -> str:
    numbers = {
        "FREQ_HZ": freq_hz, "LOW_HZ": freq_hz - channel_hz / 2.0, "HIGH_HZ": freq_hz + channel_hz / 2.0,
        "CHANNEL_HZ": channel_hz,
    }  # fmt: skip
    for word, value in numbers.items():
        command = command.replace(word, f"{value:.0f}")
    return command


class UnsetMeter:
    """What can't be read before something is set."""

    def __init__(self, words: str) -> None:
        self._words = words

    def open(self) -> None:
        """Say so."""
        raise MeterError(self._words)

    def read(self, within_s: float) -> MeterReading | None:  # noqa: ARG002 - it is never opened
        """Return nothing."""
        return None

    def close(self) -> None:
        """Nothing is open."""
