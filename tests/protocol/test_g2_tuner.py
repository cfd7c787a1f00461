"""The tuner's menu: values by their names, whatever stands around them; streams that end; DiSEqC."""

from __future__ import annotations

import pytest
from birdcage.base.errors import NoReply
from birdcage.console.codec import MARK
from birdcage.protocol.g2.tuner_values import read_agc, read_channel, read_identity, read_lock, read_volts

TRK, DVB = b"\r\nTRK>", b"dvb\r\nDVB>"


@pytest.fixture
def streaming(play, clock):
    """Return a G2 in whose tuner menu a command prints lines until a key, and the port."""

    def make(menu, prompt, command, lines, period_s=0.5):
        g2, port = play([])
        state = {"menu": b"TRK>", "running": False}

        def write(data):
            port.written += data
            for line in data.split(b"\r")[:-1]:
                if state["running"]:
                    state["running"] = False
                    port.out.clear()
                    answer = b"\r\n" + state["menu"]
                elif line == command.encode():
                    state["running"] = True
                    port.out.append((clock.monotonic(), line + b"\r\n"))
                    for number, text in enumerate(lines):
                        port.out.append((clock.monotonic() + number * period_s, text.encode() + b"\r\n"))
                    continue
                elif line == menu.encode():
                    state["menu"] = prompt
                    answer = line + b"\r\n" + prompt
                else:
                    answer = line + b"\r\n" + state["menu"]
                port.out.append((clock.monotonic(), answer))

        port.write = write
        return g2, port

    return make


@pytest.mark.parametrize(
    ("command", "lines", "question", "value"),
    [
        ("snr", ["SNR: 8.5"], lambda g: g.tuner.snr_db(), 8.5),
        ("snr", ["SNR level = 8.5 dB"], lambda g: g.tuner.snr_db(), 8.5),
        ("snr", ["reading ...", "SNR:0"], lambda g: g.tuner.snr_db(), 0.0),
        ("nid", ["NID: FFFF"], lambda g: g.tuner.network(), "none"),
        ("nid", ["NID = 0x1002"], lambda g: g.tuner.network(), "0x1002"),
        ("lnbv", ["LNB Voltage: 13.1"], lambda g: g.tuner.lnb_volts(), 13.1),
        ("lnbv", ["LNB 18.0 V"], lambda g: g.tuner.lnb_volts(), 18.0),
        (
            "agc", ["RF AGC: 1999 IF AGC: 1500 SNR: 0.0 NID: FFFF", "RF AGC: 1990 IF AGC: 1499 SNR: 7.5 NID: 1002"],
            lambda g: g.tuner.agc(2), (
                {"rf_agc": 1999, "if_agc": 1500, "snr": 0.0, "network": "none"},
                {"rf_agc": 1990, "if_agc": 1499, "snr": 7.5, "network": "0x1002"},
            ),
        ),
    ],
)  # fmt: skip
def test_a_stream_is_read_and_ended_by_enter(streaming, clock, command, lines, question, value):
    g2, port = streaming("dvb", b"DVB>", command, lines * 20)
    started = clock.monotonic()
    assert question(g2) == value
    assert clock.monotonic() - started < 2.0
    assert port.written.endswith(f"{command}\r\r".encode())
    assert b"q" not in port.written


def test_the_monitor_overwrites_its_line(streaming):
    g2, _port = streaming("adc", b"ADC>", "m", ["\rRSSI:  235", "\rRSSI:  236", "\rRSSI:  241"] * 5, 0.1)
    assert g2.adc.monitor(3) == (235, 236, 241)


def test_a_slow_stream_gives_what_came(streaming, clock):
    g2, _port = streaming("dvb", b"DVB>", "agc", ["SNR: 1.0"], 0.5)
    started = clock.monotonic()
    assert g2.tuner.agc(50)  # the dish prints one line each time it is asked
    assert clock.monotonic() - started < 60.0


def test_a_stream_may_begin_late(streaming):
    g2, _port = streaming("dvb", b"DVB>", "snr", ["", "SNR: 4.5", "SNR: 4.0"], 0.9)
    assert g2.tuner.snr_db() == 4.5


def test_a_stream_that_says_nothing_is_no_value_and_ends_all_the_same(streaming, clock):
    g2, port = streaming("dvb", b"DVB>", "snr", [])
    with pytest.raises(NoReply) as raised:
        g2.tuner.snr_db()
    assert raised.value.reason == "garbage"
    assert port.written.endswith(b"snr\r\r")


@pytest.mark.parametrize(
    ("line", "answer", "question", "value"),
    [
        ("ovraddr", "0x11", lambda d: d.address(), "0x11"),
        ("ovraddr", "Override address: 0x11", lambda d: d.address(), "0x11"),
        ("pretx", "15 ms", lambda d: d.pre_transmit_ms(), 15),
        ("rrto", "RxReplyTimeout 1 is 210 ms", lambda d: d.reply_timeout_ms(), 210),
        ("rrto", "210", lambda d: d.reply_timeout_ms(), 210),
        ("tdthresh", "110 (0.16 counts/mV)", lambda d: d.tone_threshold_counts(), 110),
        ("di2stat", "RxReplyTimeout", lambda d: d.lnb_status(), None),
        ("di2id", "RxReplyTimeout", lambda d: d.lnb_identity(), None),
        ("di2rcs", "4 0", lambda d: d.switch_status(), ("4 0",)),
        ("di2conf", "3 21180544 238 <4.5", lambda d: d.lnb_config(), ("3 21180544 238 <4.5",)),
        ("send E0 10 38 F0", "", lambda d: d.send(b"\xe0\x10\x38\xf0"), ()),
        ("send 00", "", lambda d: d.send(b"\0"), ()),
    ],
)
def test_diseqc(ask, line, answer, question, value):
    assert ask("dvb", line, answer, lambda g: question(g.tuner.diseqc)) == value


@pytest.mark.parametrize("message", [b"", b"1234567"])
def test_a_message_that_does_not_fit_never_leaves(play, message):
    g2, port = play([])
    with pytest.raises(ValueError, match="1 to 6 bytes"):
        g2.tuner.diseqc.send(message)
    assert port.written == b""


@pytest.mark.parametrize(
    ("line", "answer", "question", "value"),
    [
        ("t 5", "", lambda t: t.select(5), ()),
        ("e 3 20000", "ok", lambda t: t.set_parameter(3, 20000), ("ok",)),
        ("stats", "Reads: 7", lambda t: t.statistics(), ("Reads: 7",)),
        ("diag", "Xp 1\nXp 2", lambda t: t.diagnostics(), ("Xp 1", "Xp 2")),
        ("table", "1 974", lambda t: t.build_table(), ("1 974",)),
        ("tablex", "1 974 H", lambda t: t.build_table(extended=True), ("1 974 H",)),
        ("ls", "Total reads: 40\nNo signal: 38\nGlitches: 2", lambda t: t.lock_status()["tuner_no_signal"], 38),
    ],
)
def test_the_other_lines(ask, line, answer, question, value):
    assert ask("dvb", line, answer, lambda g: question(g.tuner)) == value


@pytest.mark.parametrize(
    ("line", "lines", "told"), [("freqs", "974\n988", ("974", "988")), ("qls", "Lock: 1", {"lock": True})]
)
def test_a_line_with_a_q_in_it_goes_out_of_a_proven_submenu(play, clock, line, lines, told):
    text = lines.replace("\n", "\r\n")
    answer = f"{line}\r\n{text}\r\nDVB>".encode()
    mark = MARK.encode() + b"\r"
    g2, _port = play([
        (b"\r", TRK), (b"dvb\r", DVB), (mark, mark + b"\nDVB>"), (b"\r", b"\r\nDVB>"), (f"{line}\r".encode(), answer),
    ])  # fmt: skip
    g2.enter_dvb_menu()
    clock.advance(5.0)
    found = g2.tuner.frequencies() if line == "freqs" else g2.tuner.quick_lock_status()
    assert found == told


IDENTITY = {"tuner_chip": "0x4515", "tuner_revision": "B0", "tuner_firmware": "113.37", "tuner_strap": "0x25018"}


def test_identity_by_its_names():
    line = "BCM4515 ID 0x4515 Rev B0 FW v113.37 strap 0x25018"
    assert read_identity((line,)) == {**IDENTITY, "tuner": line}
    split = ("ID: 0x4515", "Revision: B0", "Firmware version: 113.37", "Strap: 0x25018")
    assert read_identity(split) == {**IDENTITY, "tuner": "\n".join(split)}
    assert read_identity(("nothing known",)) == {"tuner": "nothing known"}
    assert read_identity(()) == {}


def test_a_channel_has_units_or_no_number():
    lines = ("Frequency: 1178.10 MHz", "Symbol Rate: 20000 ksps", "Polarity: H")
    found = read_channel(lines)
    assert found == {
        "frequency": 1178.1, "symbol_rate": 20000.0, "polarisation": "H", "channel": "\n".join(lines),
    }  # fmt: skip
    assert read_channel(("Freq: 1178100", "Sym: 20000")) == {"channel": "Freq: 1178100\nSym: 20000"}
    found = read_channel(("Freq = 1178100 kHz SymRate = 20 Msps",))
    assert (found["frequency"], found["symbol_rate"]) == (pytest.approx(1178.1), 20000.0)


def test_lock_by_its_names():
    assert read_lock(("Lock: 1",)) == {"lock": True}
    assert read_lock(("Locked = no",)) == {"lock": False}
    assert read_lock(("Unlocked",)) == {}
    assert read_lock(("reads: 40 no-signal: 38 glitches: 2",)) == {
        "tuner_reads": 40, "tuner_no_signal": 38, "tuner_glitches": 2,
    }  # fmt: skip


@pytest.mark.parametrize("line", ["AGC", "RF AGC", "1999 1500", ""])
def test_no_field_no_reading(line):
    assert read_agc(line) is None
    assert read_volts("LNB") is None
