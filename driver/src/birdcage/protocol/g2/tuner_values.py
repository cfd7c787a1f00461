"""What the tuner tells, and how it is read off its lines.

Only `rssi` is quoted in full (docs/reference/g2-signal.md, *Signal strength*). Of the others the sources tell the
fields, not the form: each is looked for by its name, and is None if it is not found; `lines` are then what there is.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.protocol.g2.reading import END, NUMBER, START

_RF = re.compile(rf"\bRF[ _]?(?:AGC)?\s*[:=]?\s*({NUMBER})", re.IGNORECASE)
_IF = re.compile(rf"\bIF[ _]?(?:AGC)?\s*[:=]?\s*({NUMBER})", re.IGNORECASE)
_SNR = re.compile(rf"\bSNR(?:\s+level)?\s*[:=]?\s*({NUMBER})", re.IGNORECASE)
_NID = re.compile(rf"\bNID\s*[:=]?\s*(?:0x)?([0-9A-F]{{1,4}}){END}", re.IGNORECASE)
_VOLTS = re.compile(rf"{START}({NUMBER})\s*V?\s*$|[:=]\s*({NUMBER})", re.IGNORECASE)
_NO_NETWORK = 0xFFFF


@dataclass(frozen=True, slots=True)
class AgcReading:
    """One line of `agc`: what the gain control does, and what the demodulator hears."""

    rf_agc_counts: int | None
    if_agc_counts: int | None
    snr_db: float | None
    network_id: int | None
    """None when it hears no network (`FFFF`), too."""


@dataclass(frozen=True, slots=True)
class TunerIdentity:
    """What `config` tells: ID 0x4515, revision B0, firmware 113.37, strap 0x25018.

    Source: docs/reference/g2-signal.md, *Tuner*.
    """

    chip_id: int | None
    revision: str | None
    firmware: str | None
    strap: int | None
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ChannelParameters:
    """What `dis` tells of the channel. A number whose unit is not printed is not taken for one."""

    frequency_mhz: float | None
    symbol_rate_ksps: float | None
    polarisation: str | None
    """`H` (18 V) or `V` (13 V)."""
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class LockStatus:
    """What `ls` or `qls` tells: how often it read, heard nothing and saw a glitch, and which networks."""

    locked: bool | None
    reads: int | None
    no_signal: int | None
    glitches: int | None
    lines: tuple[str, ...]


def read_agc(line: str) -> AgcReading | None:
    """Read one line of `agc`; None when it names none of the fields."""
    rf, inter = _RF.search(line), _IF.search(line)
    if not (rf or inter or _SNR.search(line) or _NID.search(line)):
        return None
    return AgcReading(
        int(float(rf[1])) if rf else None,
        int(float(inter[1])) if inter else None,
        read_snr_db(line),
        read_network(line) or None,
    )


def read_snr_db(line: str) -> float | None:
    """Read `SNR: 8.5`; None for another line."""
    match = _SNR.search(line)
    return float(match[1]) if match else None


def read_network(line: str) -> int | None:
    """Read `NID: 101A`; 0 for none (`FFFF`), None for another line."""
    match = _NID.search(line)
    if match is None:
        return None
    network = int(match[1], 16)
    return 0 if network == _NO_NETWORK else network


def read_volts(line: str) -> float | None:
    """Read a line of `lnbv`: the number after its name, or at its end; None when there is none."""
    match = _VOLTS.search(line)
    return float(match[1] or match[2]) if match else None


def read_identity(lines: tuple[str, ...]) -> TunerIdentity:
    """Read `config`."""
    text = "\n".join(lines)
    chip, strap = _hex(text, r"\bID"), _hex(text, r"\bstrap\w*")
    return TunerIdentity(
        chip,
        _text(text, r"\brev(?:ision)?\b\.?\s*[:=]?\s*([A-Z]\d)" + END),
        _text(text, r"\b(?:FW|firmware)\b(?:\s*ver(?:sion)?)?\s*[:=]?\s*v?(\d+(?:\.\d+)+)" + END),
        strap,
        lines,
    )


def read_channel(lines: tuple[str, ...]) -> ChannelParameters:
    """Read `dis`."""
    text = "\n".join(lines)
    frequency = re.search(rf"\bfreq\w*[^\n\d]*({NUMBER})\s*([kMG])Hz", text, re.IGNORECASE)
    rate = re.search(rf"\bsym\w*[^\n\d]*({NUMBER})\s*([kM])(?:sps|sym/s|S/s|Bd|baud)", text, re.IGNORECASE)
    scale = {"k": 1e-3, "m": 1.0, "g": 1e3}
    polarisation = _text(text, r"\bpol\w*[^\n:=]*[:=]\s*([HV])" + END)
    return ChannelParameters(
        float(frequency[1]) * scale[frequency[2].lower()] if frequency else None,
        float(rate[1]) * scale[rate[2].lower()] * 1e3 if rate else None,
        polarisation.upper() if polarisation else None,
        lines,
    )


def read_lock(lines: tuple[str, ...]) -> LockStatus:
    """Read `ls` or `qls`."""
    text = "\n".join(lines)
    locked = _text(text, r"\block(?:ed)?(?:\s+status)?\s*[:=]\s*(yes|no|locked|unlocked|true|false|[01])" + END)
    return LockStatus(
        locked.lower() in ("yes", "locked", "true", "1") if locked else None,
        _count(text, r"reads"),
        _count(text, r"no[ -]?sig(?:nal)?"),
        _count(text, r"glitch(?:es)?"),
        lines,
    )


def _hex(text: str, name: str) -> int | None:
    match = re.search(rf"{name}\s*[:=]?\s*0x([0-9A-F]+){END}", text, re.IGNORECASE)
    return int(match[1], 16) if match else None


def _text(text: str, pattern: str) -> str | None:
    match = re.search(pattern, text, re.IGNORECASE)
    return match[1] if match else None


def _count(text: str, name: str) -> int | None:
    match = re.search(rf"\b{name}(?:\s+(?:count|reads))?\s*[:=]\s*(\d+){END}", text, re.IGNORECASE)
    return int(match[1]) if match else None
