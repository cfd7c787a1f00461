"""What the tuner tells, and how it is read off its lines.

Only `rssi` is quoted in full (docs/reference/g2-signal.md, *Signal strength*). Of the others the sources tell the
fields, not the form: each is looked for by its name, and left out if it is not found. The lines as printed are then
what there is: `tuner`, `channel` and `lock_status`.
"""

from __future__ import annotations

import re

from birdcage.protocol.trk.reading import END, NUMBER, START, Fields, fields_of, printed
from birdcage.rotator.feature import NO_NETWORK, Value

_RF = re.compile(rf"\bRF[ _]?(?:AGC)?\s*[:=]?\s*({NUMBER})", re.IGNORECASE)
_IF = re.compile(rf"\bIF[ _]?(?:AGC)?\s*[:=]?\s*({NUMBER})", re.IGNORECASE)
_SNR = re.compile(rf"\bSNR(?:\s+level)?\s*[:=]?\s*({NUMBER})", re.IGNORECASE)
_NID = re.compile(rf"\bNID\s*[:=]?\s*(?:0x)?([0-9A-F]{{1,4}}){END}", re.IGNORECASE)
_VOLTS = re.compile(rf"{START}({NUMBER})\s*V?\s*$|[:=]\s*({NUMBER})", re.IGNORECASE)
_TO_MHZ_OR_MSPS = {"k": 1e-3, "m": 1.0, "g": 1e3}


def _named(pattern: str) -> re.Pattern[str]:
    return re.compile(pattern + END, re.IGNORECASE)


def _counted(name: str) -> re.Pattern[str]:
    return _named(rf"\b{name}(?:\s+(?:count|reads))?\s*[:=]\s*(\d+)")


def _whole(match: re.Match[str]) -> int:
    return int(float(match[1]))


def _network(match: re.Match[str]) -> str:
    return NO_NETWORK if match[1].upper() == "FFFF" else f"0x{int(match[1], 16):04X}"


def _scaled(match: re.Match[str]) -> float:
    return float(match[1]) * _TO_MHZ_OR_MSPS[match[2].lower()]


_AGC: Fields = {
    "rf_agc": (_RF, _whole),
    "if_agc": (_IF, _whole),
    "snr": (_SNR, lambda match: float(match[1])),
    "network": (_NID, _network),
}
_CONFIG: Fields = {
    "tuner_chip": (_named(r"\bID\s*[:=]?\s*(0x[0-9A-F]+)"), lambda match: match[1]),
    "tuner_revision": (_named(r"\brev(?:ision)?\b\.?\s*[:=]?\s*([A-Z]\d)"), lambda match: match[1]),
    "tuner_firmware": (
        _named(r"\b(?:FW|firmware)\b(?:\s*ver(?:sion)?)?\s*[:=]?\s*v?(\d+(?:\.\d+)+)"), lambda match: match[1]
    ),
    "tuner_strap": (_named(r"\bstrap\w*\s*[:=]?\s*(0x[0-9A-F]+)"), lambda match: match[1]),
}  # fmt: skip
_DIS: Fields = {
    "transponder": (_named(r"\btransponder\s*[:=]?\s*(\d+)"), _whole),
    "frequency": (re.compile(rf"\bfreq\w*[^\n\d]*({NUMBER})\s*([kMG])Hz", re.IGNORECASE), _scaled),
    "symbol_rate": (
        re.compile(rf"\bsym\w*[^\n\d]*({NUMBER})\s*([kM])(?:sps|sym/s|S/s|Bd|baud)", re.IGNORECASE),
        lambda match: _scaled(match) * 1e3,
    ),
    "polarisation": (_named(r"\bpol\w*[^\n:=]*[:=]\s*([HV])"), lambda match: match[1].upper()),
}
_LOCK: Fields = {
    "lock": (
        _named(r"\block(?:ed)?(?:\s+status)?\s*[:=]\s*(yes|no|locked|unlocked|true|false|[01])"),
        lambda match: match[1].lower() in ("yes", "locked", "true", "1"),
    ),
    "tuner_reads": (_counted(r"reads"), _whole),
    "tuner_no_signal": (_counted(r"no[ -]?sig(?:nal)?"), _whole),
    "tuner_glitches": (_counted(r"glitch(?:es)?"), _whole),
}


def read_agc(line: str) -> dict[str, Value] | None:
    """Read one line of `agc`: `rf_agc` and `if_agc` in counts, `snr` in dB, `network`; None when it names none."""
    return fields_of(line, _AGC) or None


def read_snr_db(line: str) -> float | None:
    """Read `SNR: 8.5`; None for another line."""
    match = _SNR.search(line)
    return float(match[1]) if match else None


def read_network(line: str) -> str | None:
    """Read `NID: 101A` as `0x101A`, or `none` (`FFFF`); None for another line."""
    match = _NID.search(line)
    return _network(match) if match else None


def read_volts(line: str) -> float | None:
    """Read a line of `lnbv`: the number after its name, or at its end; None when there is none."""
    match = _VOLTS.search(line)
    return float(match[1] or match[2]) if match else None


def read_identity(lines: tuple[str, ...]) -> dict[str, Value]:
    """Read `config`: `tuner_chip` 0x4515, `tuner_revision` B0, `tuner_firmware` 113.37, `tuner_strap` 0x25018.

    Source: docs/reference/g2-signal.md, *Tuner*.
    """
    return {**fields_of("\n".join(lines), _CONFIG), **printed("tuner", lines)}


def read_channel(lines: tuple[str, ...]) -> dict[str, Value]:
    """Read `dis`: `transponder`, `frequency` in MHz, `symbol_rate` in ksps, `polarisation`, `H` (18 V) or `V` (13 V).

    A number whose unit is not printed is left out.
    """
    return {**fields_of("\n".join(lines), _DIS), **printed("channel", lines)}


def read_lock(lines: tuple[str, ...]) -> dict[str, Value]:
    """Read `ls` or `qls`: `lock`, and how often it read, heard nothing and saw a glitch."""
    return fields_of("\n".join(lines), _LOCK)
