"""What a G2's tuner tells, and lets be set: signal, channel, supply of the LNB, and the bus on its coax.

Source: docs/reference/g2-commands.md, *DVB>* and *PEAK>*; docs/reference/g2-signal.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.errors import OutOfRange
from birdcage.coax.messages import typed_message
from birdcage.protocol.g2.diseqc import answer_in_words
from birdcage.protocol.g2.feature_rows import FROM_0, Question, counts, in_lines, lines, one, stream, text, told, under
from birdcage.rotator.feature import (
    DISEQC,
    ENABLE_LNA,
    EVEN_LEVEL,
    LOCK,
    NETWORK,
    ODD_LEVEL,
    RSSI,
    SNR,
    TRANSPONDER,
    Feature,
    FeatureKind,
    FeaturePage,
    HealthMark,
    Range,
    Value,
    Writer,
)
from birdcage.rotator.feature_table import FeatureRow

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol

RSSI_READS = 10
_PAGE = FeaturePage.RECEIVER
_DIS = Question("dvb", "dis")
_BUILDS = (
    "The dish builds the table anew, which takes up to a minute. It hears nothing meanwhile: no STOP reaches it, and "
    "nothing else is read."
)
_TOGGLES = (
    "Each reading switches the LNB supply to 18 V and to 13 V. Which of them stays afterwards is not known. Anything "
    "else on that cable may be damaged."
)


def supplied(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Feed the LNB with 13 V."""
    dish.enable_lna()
    return {ENABLE_LNA: True}


def channel_of(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Return what the tuner is tuned to (`dis`)."""
    return dish.tuner.channel()


def tuned(dish: CarryoutG2Protocol, transponder: int) -> dict[str, Value]:
    """Tune to a transponder: odd ones are sent vertical, at 13 V, even ones horizontal, at 18 V."""
    dish.tuner.select(transponder)
    return {TRANSPONDER: float(transponder)}


def messaged(dish: CarryoutG2Protocol, typed: str) -> dict[str, Value]:
    """Send a message that was typed in hex, and tell how it went. OutOfRange (nothing sent) for what is none."""
    try:
        message = typed_message(typed)
    except ValueError as wrong:
        raise OutOfRange(f"{wrong} Nothing was sent.") from None
    return {DISEQC: answer_in_words(message, dish.tuner.diseqc.send(message))}


def _answer(printed: tuple[str, ...] | None) -> str:
    """Return what an LNB or a switch has answered, in a line."""
    return "no answer" if printed is None else " / ".join(printed)


def _asked(line: str, ask: Callable[[CarryoutG2Protocol], tuple[str, ...] | None], name: str, label: str) -> FeatureRow:
    return one(Question("dvb", line), lambda dish: _answer(ask(dish)), text(name, label))


def _table(line: str, name: str, label: str) -> FeatureRow:
    extended = line == "tablex"
    row = in_lines(Question("dvb", line), lambda dish: dish.tuner.build_table(extended=extended), name, label)
    return replace(row, feature=replace(row.feature, read_hazard=_BUILDS))


def _polarised(name: str, label: str) -> Feature:
    return replace(counts(name, label), read_hazard=_TOGGLES)


def _levels(dish: CarryoutG2Protocol) -> dict[str, Value]:
    """Hear both polarisations in turn (`rssits`), which switches the LNB's supply."""
    even, odd = dish.peak.rssi()
    return {EVEN_LEVEL: float(even), ODD_LEVEL: float(odd)}


_SIGNAL = (
    one(Question("dvb", f"rssi {RSSI_READS}", min_interval_s=0.0),
        lambda dish: float(dish.get_rssi(RSSI_READS).average),
        replace(counts(RSSI, "Signal strength"), samples=RSSI_READS)),
    one(stream("snr"), lambda dish: dish.tuner.snr_db(), Feature(SNR, "Signal-to-noise ratio", "dB")),
    one(stream("nid"), lambda dish: dish.tuner.network(), text(NETWORK, "Network heard, or none")),
    *told(stream("agc"), lambda dish: dish.tuner.agc()[0],
          Feature("rf_agc", "Gain control, RF", "counts"), Feature("if_agc", "Gain control, IF", "counts")),
    *told(Question("dvb", "ls"), lambda dish: dish.tuner.lock_status(),
          Feature(LOCK, "Tuner has locked", kind=FeatureKind.SWITCH),
          Feature("tuner_reads", "Reads of the tuner", range=FROM_0),
          Feature("tuner_no_signal", "Reads without a signal", range=FROM_0),
          Feature("tuner_glitches", "Reads with a glitch", range=FROM_0),
          lines("lock_status", "Lock status, as printed")),
    in_lines(Question("dvb", "stats"), lambda dish: dish.tuner.statistics(), "tuner_statistics",
             "Statistics of reads, as printed"),
)  # fmt: skip
_CHANNEL = (
    FeatureRow(
        _DIS.about(Feature(
            TRANSPONDER, "Transponder that the tuner listens to", range=Range(1.0, 32.0), writer=Writer.UNTIL_RESTART,
            note="Odd ones are vertical, at 13 V, even ones horizontal, at 18 V.",
        )),
        channel_of,
        lambda dish, number: tuned(dish, int(number)),
    ),
    *told(_DIS, channel_of,
          Feature("frequency", "Frequency behind the LNB", "MHz"), Feature("symbol_rate", "Symbol rate", "ksps"),
          text("polarisation", "Polarisation (H or V)"), lines("channel", "Parameters of the channel, as printed")),
    in_lines(Question("dvb", "freqs", 3), lambda dish: dish.tuner.frequencies(), "frequencies",
             "Frequencies of the tuner, as printed"),
    _table("table", "transponders", "Table of transponders, as printed"),
    _table("tablex", "transponders.extended", "Table of transponders with more of each, as printed"),
)  # fmt: skip
_LNB = (
    FeatureRow(
        Question("dvb", "lnbdc odu", min_interval_s=0.0).about(Feature(
            ENABLE_LNA, "Supply of 13 V for the LNB", kind=FeatureKind.MOMENTARY, writer=Writer.AT_ONCE,
            hazard="This switches the LNB supply from 18 V to 13 V: the polarisation becomes vertical. No command back "
            "to 18 V is known; a power cycle of the dish brings it back. Anything else on that cable may be damaged.",
        )),
        write=lambda dish, _value: supplied(dish),
    ),
    one(stream("lnbv"), lambda dish: dish.tuner.lnb_volts(),
        Feature("lnb_supply", "Supply of the LNB", "V", range=Range(0.0, 30.0), health=HealthMark("LNB"))),
    *told(Question("peak", "rssits"), _levels,
          _polarised(EVEN_LEVEL, "Level of even transponders (18 V, horizontal)"),
          _polarised(ODD_LEVEL, "Level of odd transponders (13 V, vertical)")),
)  # fmt: skip
_TUNER = told(
    Question("dvb", "config", min_interval_s=600.0),  # it does not change while the dish has power
    lambda dish: dish.tuner.identity(),
    text("tuner_chip", "Chip of the tuner"), text("tuner_revision", "Revision of the tuner"),
    text("tuner_firmware", "Firmware of the tuner"), text("tuner_strap", "Strap of the tuner"),
    lines("tuner", "Versions of the tuner, as printed"),
)  # fmt: skip
_DISEQC = (
    one(Question("dvb", "ovraddr"), lambda dish: dish.tuner.diseqc.address(), text("diseqc_address", "DiSEqC address")),
    one(Question("dvb", "pretx"), lambda dish: dish.tuner.diseqc.pre_transmit_ms(),
        Feature("diseqc_pre_transmit", "DiSEqC silence before a message", "ms")),
    one(Question("dvb", "rrto"), lambda dish: dish.tuner.diseqc.reply_timeout_ms(),
        Feature("diseqc_reply_timeout", "DiSEqC wait for an answer", "ms")),
    one(Question("dvb", "tdthresh"), lambda dish: dish.tuner.diseqc.tone_threshold_counts(),
        counts("diseqc_tone_threshold", "DiSEqC threshold of the tone")),
    one(Question("peak", "ts"), lambda dish: dish.peak.switch_status(),
        Feature("switch_status", "Bits of an EchoStar switch, 0 for none", range=Range(0.0, 15.0))),
    _asked("di2conf", lambda dish: dish.tuner.diseqc.lnb_config(), "lnb_config", "Configuration that the LNB answers"),
    _asked("di2id", lambda dish: dish.tuner.diseqc.lnb_identity(), "lnb_id", "Identity that the LNB answers"),
    _asked("di2stat", lambda dish: dish.tuner.diseqc.lnb_status(), "lnb_status", "Status that the LNB answers"),
    _asked("di2rcs", lambda dish: dish.tuner.diseqc.switch_status(), "committed_switch",
           "State that the committed switch answers"),
    FeatureRow(
        Question("dvb", "send", min_interval_s=0.0).about(Feature(
            DISEQC, "Message to LNB and switches, 1 to 6 bytes in hex", kind=FeatureKind.TEXT, writer=Writer.AT_ONCE,
            hazard="This sends a message to what hangs on the coax: polarisation, band or input may change, and a "
            "positioner may move.",
            told=False,
            note="E0 10 38 F4 chooses the second input of a switch. Only what is on the coax of the dish's own tuner "
            "hears it.",
        )),
        write=lambda dish, typed: messaged(dish, str(typed)),
    ),
)  # fmt: skip

RECEIVER = (
    *under(_PAGE, "Signal", *_SIGNAL),
    *under(_PAGE, "Channel", *_CHANNEL),
    *under(_PAGE, "LNB", *_LNB),
    *under(_PAGE, "Tuner", *_TUNER),
    *under(_PAGE, "DiSEqC", *_DISEQC),
)
