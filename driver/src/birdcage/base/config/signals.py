"""Where a signal level can be read: one profile each, which a feed names; some are built in."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, Literal

from birdcage.base.config.field import Complaint, Section, setting

OWN_TUNER, RECEIVER = "tuner", "rigctl"
"""The dish's own tuner, and the receiver at `[radio] rigctld`: they have no profile."""


@dataclass(frozen=True, slots=True)
class SignalProfile(Section):
    """`[signal.NAME]`: a program or a receiver that tells a level. `feed.NAME.signal` chooses it by its name."""

    section: ClassVar[str] = "signal.NAME"

    kind: Literal["command", "http", "rtl_tcp", "rigctl"] = setting(
        "command",
        "A program that prints levels, a URL with JSON, an RTL-SDR behind rtl_tcp, or a receiver over rigctl.",
    )
    command: str | None = setting(
        None, "The program with its words; FREQ_HZ, LOW_HZ, HIGH_HZ and CHANNEL_HZ stand for the channel."
    )
    prints: Literal["number", "rtl_power"] = setting(
        "number", "What a line of it holds: a number first, or the levels of rtl_power."
    )
    ask: bool = setting(False, "Send it an empty line for each reading; else it prints as it likes.")
    url: str | None = setting(None, "Where the JSON is: http://localhost:8081/api.")
    path: str | None = setting(None, "Where the number is in the JSON: psk_demod.snr; * stands for any name.")
    address: str | None = setting(None, "Where rtl_tcp or the receiver listens: localhost:1234.")
    freq_hz: float | None = setting(
        None, "Middle of the channel, as the receiver tunes it; not set: the middle of the feed, less its LO.",
        minimum=1e3, maximum=1e11,
    )  # fmt: skip
    channel_hz: float = setting(200e3, "Width of the channel whose power is measured.", minimum=1e3, maximum=2.4e6)
    sample_rate_hz: float = setting(1.024e6, "How fast rtl_tcp samples.", minimum=225.001e3, maximum=2.4e6)
    gain_db: float | None = setting(
        28.0, "Gain of the RTL-SDR; a negative one hands it to the tuner, whose levels can't be compared.",
        minimum=-1.0, maximum=60.0,
    )  # fmt: skip
    unit: str = setting("dB", "Unit of the values.")
    scale: Literal["log", "linear"] = setting("log", "Whether equal steps are equal ratios of power, as in dB.")
    every_s: float = setting(0.5, "How often it is asked.", minimum=0.05, maximum=60.0)
    dwell_s: float = setting(0.0, "How long a reading measures, up to the moment that it is told.", minimum=0.0,
                             maximum=600.0)  # fmt: skip

    def complaints(self) -> Iterator[Complaint]:
        """Yield what its kind needs and has not."""
        needed = {"command": "command", "http": "url", "rtl_tcp": "address", "rigctl": "address"}[self.kind]
        if getattr(self, needed) is None:
            yield needed, f"is missing: a signal of the kind {self.kind} needs it"
        if self.kind == "http" and self.path is None:
            yield "path", "is missing: it says where the number stands in the JSON"
        if self.kind == "rtl_tcp" and self.channel_hz > self.sample_rate_hz:
            yield "channel_hz", f"is {self.channel_hz:g}, more than sample_rate_hz ({self.sample_rate_hz:g})"


PRESETS: Mapping[str, SignalProfile] = MappingProxyType({
    "satdump": SignalProfile("http", url="http://localhost:8081/api", path="*.snr", every_s=0.5, dwell_s=1.0),
    "gqrx": SignalProfile("rigctl", address="localhost:7356", unit="dBFS", every_s=0.2),
    "sdrpp": SignalProfile("rigctl", address="localhost:4532", every_s=0.2),
    "rtl_tcp": SignalProfile("rtl_tcp", address="localhost:1234", unit="dBFS", every_s=0.1),
    "rtl_power": SignalProfile(
        "command", command="rtl_power -f LOW_HZ:HIGH_HZ:CHANNEL_HZ -i 1 -", prints="rtl_power", dwell_s=1.0,
    ),
})  # fmt: skip
"""Programs that many have, as they are when nothing else is said; a table of the same name changes one."""
