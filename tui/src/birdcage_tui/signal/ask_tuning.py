"""How an RTL-SDR is tuned: the dialog that asks for frequency, sample rate, channel and gain."""

from __future__ import annotations

from birdcage.signal.rtl_tcp_meter import Tuned
from birdcage.signal.tuning import checked_tuning

from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

WORDS = "What the receiver tunes to, behind your LNB or converter. It counts at once, and birdcage.toml keeps it."


def tuning_question(now: Tuned, label: str) -> FieldsScreen:
    """Return what is asked; `now` is how it is tuned."""
    gain = "auto" if now.gain_db is None or now.gain_db < 0.0 else f"{now.gain_db:g}"
    rows = (
        FieldRow("channel, MHz", f"{now.freq_hz / 1e6:.9g}" if now.freq_hz else "", "the middle of what is measured"),
        FieldRow("sample rate, kHz", f"{now.sample_rate_hz / 1e3:g}", "226 to 300, or 901 to 2400"),
        FieldRow("channel width, kHz", f"{now.channel_hz / 1e3:g}", "1 to the sample rate"),
        FieldRow("gain, dB", gain, "0 to 60, or auto; levels by auto can't be compared"),
    )

    def wrong(values: Values) -> str:
        try:
            read_tuning(values)
        except ValueError as error:
            return f"{error}."
        return ""

    return FieldsScreen(f"Tune {label}", WORDS, rows, wrong, enter="Enter tunes")


def read_tuning(values: Values) -> Tuned:
    """Return what the lines say. ValueError says what is wrong."""
    freq, rate, width, gain = (value.strip().lower() for value in values)
    try:
        freq_hz, rate_hz, width_hz = float(freq) * 1e6, float(rate) * 1e3, float(width) * 1e3
        gain_db = None if gain == "auto" else float(gain.removesuffix("db"))
    except ValueError:
        raise ValueError("Each line is a number: 1420.4 MHz, 1024 kHz, 200 kHz, 28 dB or auto") from None
    return checked_tuning(freq_hz, rate_hz, width_hz, gain_db)
