"""The tuner menu: its two pages of help, lock and network from the sky, tables, search, and what power-on forgets."""

from __future__ import annotations

import re

import pytest
from birdcage.sim.almanac import geostationary
from birdcage.sim.g2.firmware import menus

ON_SATELLITE = "az={:.3f}&el={:.3f}"


def at(slot):
    az, el = geostationary(slot, 39.1, -95.7)
    return ON_SATELLITE.format(az - 360, el)


def tuner(terminal, options="az=0&el=58"):
    dish = terminal(options)
    dish.ask("dvb", "DVB>")
    return dish


def ask(dish, line, within=20.0):
    return dish.ask(line, "\nDVB>", within=within).split("\r\n", 1)[1].removesuffix("DVB>")


def names(text):
    return {line.split()[0] for line in text.splitlines() if line.strip()}


def test_help_has_two_pages_that_hold_every_command_once(terminal):
    dish = tuner(terminal)
    first, second = names(ask(dish, "?")), names(ask(dish, "man"))
    assert first == names(ask(dish, "help"))
    assert first & second == set()
    assert first | second == set(menus(dish.device.board)["dvb"].commands) - {"?"}
    assert {"srch_mode", "stats", "di2conf", "send", "tdthresh"} <= second  # named in the notes
    assert "srch_mode" in ask(dish, "help srch_mode")


@pytest.mark.parametrize(
    ("command", "line"),
    [
        ("snr", r"SNR: (8|9|1\d)\.\d\r\n"),
        ("nid", r"NID: 1001\r\n"),
        ("agc", r"RF AGC: \d+ IF AGC: \d+ SNR: \d+\.\d NID: 1001\r\n"),
    ],
)
def test_streams_tell_of_the_satellite_in_the_beam(terminal, command, line):
    dish = tuner(terminal, at(-119.0))
    ask(dish, "lnbdc odu")
    dish.type(f"{command}\r")
    assert re.search(line, dish.listen(1.2))


def test_without_its_voltage_there_is_no_network(terminal):
    dish = tuner(terminal, at(-119.0))  # transponder 15 is vertical, the LNB at 18 V
    dish.type("nid\r")
    assert "NID: FFFF\r\n" in dish.listen(0.3)
    dish.ask("q", "DVB>")
    assert ask(dish, "t 16") == "Transponder: 16\r\n"
    dish.type("nid\r")
    assert "NID: 1001\r\n" in dish.listen(0.3)


def test_lock_status_counts(terminal):
    dish = tuner(terminal, at(-119.0))
    assert ask(dish, "qls").startswith("Lock: 0 ")
    ask(dish, "lnbdc odu")
    assert ask(dish, "qls").startswith("Lock: 1 ")
    reply = ask(dish, "ls")
    assert "Lock: 1\r\nTotal reads: 3 No signal: 1 Glitches: 0\r\nNID table:\r\n  1001 2\r\n  FFFF 1\r\n" in reply
    assert "Reads: 3 Locks: 2" in ask(dish, "stats")
    low, high = map(int, re.findall(r"(?:min|max): (\d+)", ask(dish, "stats")))
    assert 500 < low <= high


def test_a_table_looks_at_each_transponder_at_its_own_voltage(terminal):
    dish = tuner(terminal, at(-119.0))
    start = dish.now
    rows = ask(dish, "table").splitlines()
    assert dish.now - start >= 32 * 0.05
    assert len(rows) == 32
    assert all("Lock:1" in row and "NID:1001" in row for row in rows)
    assert rows[14].startswith(" 15) 1178120 kHz V")
    assert ask(dish, "dis").startswith("Transponder: 15\r\n")


def test_shuffling_reorders_the_table_until_def(terminal):
    dish = tuner(terminal)
    order = ask(dish, "shuf").split()[1:]
    assert sorted(map(int, order)) == list(range(1, 33)) != list(map(int, order))
    shown = [row.split(")")[0].strip() for row in ask(dish, "table").splitlines()]
    assert shown == order
    ask(dish, "def")
    assert ask(dish, "table").startswith("  1)")


@pytest.mark.parametrize("forget", ["def", "power"])
def test_changes_last_until_def_or_power_on(terminal, forget):
    dish = tuner(terminal)
    changes = ("t 4", "e 0 1000000", "e 2 1", "srch_mode 2", "tabto 9", "to 8", "pretx 7", "rrto 6", "ovraddr 0x14")
    for change in changes:
        assert "Invalid" not in ask(dish, change)
    assert "Frequency: 1000000 kHz" in ask(dish, "dis")
    assert "Polarity: V" in ask(dish, "dis")
    changed = [ask(dish, name) for name in ("srch_mode", "tabto", "to", "pretx", "rrto", "ovraddr")]
    assert [re.findall(r"\d+", text)[-1] for text in changed] == ["2", "9", "8", "7", "6", "14"]
    if forget == "def":
        ask(dish, "def")
    else:
        dish.device.power_cycle()
        dish.listen(30.0)
        dish.ask("dvb", "DVB>")
    again = [ask(dish, name) for name in ("srch_mode", "tabto", "to", "pretx", "rrto", "ovraddr")]
    assert [re.findall(r"\d+", text)[-1] for text in again] == ["0", "50", "500", "15", "210", "11"]
    assert ask(dish, "dis").startswith("Transponder: 15\r\n  0) Frequency: 1178120 kHz")
    ask(dish, "t 4")
    assert "Polarity: H" in ask(dish, "dis")


def test_power_off_deafens(terminal):
    dish = tuner(terminal)
    assert ask(dish, "pwr 0") == "Tuner power: OFF\r\n"
    assert "RSSI[avg: 0 cur: 0]" in ask(dish, "rssi 3")
    assert ask(dish, "pwr 1") == "Tuner power: ON\r\n"
    assert int(re.search(r"avg: (\d+)", ask(dish, "rssi 3"))[1]) == pytest.approx(400, abs=4)


def test_range_tells_the_spread_of_the_noise(terminal):
    low, high, span = map(int, re.findall(r"\d+", ask(tuner(terminal, "az=0&el=58&rssi_noise=4"), "range")))
    assert (low, high) == (pytest.approx(391, abs=5), pytest.approx(409, abs=5))
    assert span == high - low


def test_search_finds_what_is_in_the_beam_and_stays(terminal):
    dish = tuner(terminal, at(-119.0) + "&nvs20=0")
    reply = ask(dish, "srch")
    assert reply.count("Lock:1") == 32
    assert reply.endswith("Search done: 32 of 32\r\n")
    assert not dish.port.dish.truth().moving


@pytest.mark.parametrize(("options", "moves"), [("nvs20=0", True), ("nvs20=1", False), ("nvs20=0&srch_moves=0", False)])
def test_search_sets_the_dish_going_only_when_it_may(terminal, options, moves):
    dish = tuner(terminal, f"az=0&el=58&{options}")
    assert "Search done: 0 of 32" in ask(dish, "srch")
    dish.clock.advance(0.2)
    assert dish.port.dish.truth().moving is moves
    dish.device.power_off()
    dish.clock.advance(60.0)
    assert not dish.port.dish.truth().moving


# --- DiSEqC


def test_a_question_without_switch_takes_as_long_as_the_timeout(terminal):
    dish = tuner(terminal)
    ask(dish, "rrto 900")
    start = dish.now
    assert ask(dish, "di2id") == "RxReplyTimeout\r\n"
    assert 0.9 < dish.now - start < 1.1


def test_what_the_sources_disagree_about(terminal):
    dish = tuner(terminal, "di2conf=timeout&di2cs_bare=parameter")
    assert ask(dish, "di2conf") == "RxReplyTimeout\r\n"
    assert ask(dish, "di2cs") == "Invalid parameter.\r\n"
    assert ask(dish, "di2cs 2") == "RxReplyTimeout\r\n"


def test_a_switch_answers_and_turns(terminal):
    dish = tuner(terminal, "switch_port=1")
    assert ask(dish, "di2rcs") == "Committed switch: 0xF0\r\n"
    assert ask(dish, "send E0 10 38 F8") == "Tx: E0 10 38 F8\r\n"
    assert ask(dish, "di2rcs") == "Committed switch: 0xF8\r\n"
    assert ask(dish, "send E0 10 38 33") == "Tx: E0 10 38 33\r\n"
    assert ask(dish, "di2rcs") == "Committed switch: 0xF8\r\n", "polarisation and band are no port"
    assert ask(dish, "di2cs 2") == "Committed switch: 0xF4\r\n"
    assert ask(dish, "send E2 10 38 08") == "Tx: E2 10 38 08\r\nRx: E4\r\n"
    assert ask(dish, "di2rcs") == "Committed switch: 0xFC\r\n", "what is not cleared stays"
    for line in ("di2id", "di2stat", "di2sc", "di2conf"):
        assert "RxReplyTimeout" not in ask(dish, line)
    dish.ask("q", "TRK>")
    dish.ask("peak", "PEAK>")
    assert "SW Status: 0b1000 8\r\n" in dish.ask("ts", "\nPEAK>")


def test_without_a_switch_no_packet_makes_one(terminal):
    dish = tuner(terminal)
    ask(dish, "send E0 10 38 F2")
    ask(dish, "di2cs 3")
    assert ask(dish, "di2rcs") == "RxReplyTimeout\r\n"
