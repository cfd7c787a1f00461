"""The firmware's own sweeps, the raw level, and what hangs the shell."""

from __future__ import annotations

import re

import pytest

POINT = re.compile(r"Motor:(\d) Angle:(\d+) RSSI:(\d+) Lock:([01]) SNR:(\d+) Scan Delta:(\d+)( Xponder:\d+)?")


def at(terminal, options="", menu="mot"):
    dish = terminal(options)
    dish.ask(menu, f"{menu.upper()}>")
    return dish


def points(heard):
    return [tuple(int(text) for text in match.groups()[:6]) for match in POINT.finditer(heard)]


def test_ten_degrees_in_steps_of_one_with_three_transponders_are_thirty_lines(terminal):
    found = points(at(terminal, "az=-180").ask("azscanwxp 0 10 100 3", "MOT>", within=60))
    assert len(found) == 30
    assert [angle for _, angle, *_ in found[::3]] == pytest.approx([18000 + 100 * n for n in range(10)], abs=7)
    assert {(motor, delta) for motor, _, _, _, _, delta in found} == {(0, 100)}


def test_it_hears_what_the_tuner_hears_where_it_is(terminal):
    dish = at(terminal, "az=-220&el=38&overshoot=0")  # the arc south of 39 N: satellites, and gaps between them
    board = dish.device.board
    found = points(dish.ask("azscanwxp 0 60 100 2", "MOT>", within=60))
    vertical, horizontal = found[::2], found[1::2]
    for _, centideg, rssi, *_ in found:
        assert rssi == pytest.approx(board.level(dish.now, centideg / 100, 38.0), abs=5)
    levels = [rssi for _, _, rssi, *_ in found]
    assert min(levels) < 420 < 480 < max(levels)
    strong = max(horizontal, key=lambda point: point[2])
    assert strong[3] == 1  # even ones are horizontal, which 18 V at the LNB selects
    assert strong[4] == pytest.approx((strong[2] - board.sky.floor(38.0)) / 15, abs=1)
    assert {(lock, snr) for *_, lock, snr, _ in vertical} == {(0, 0)}


def test_the_tuner_goes_through_the_transponders(terminal):
    dish = at(terminal, "az=-180&xponder_style=labelled")
    heard = dish.ask("azscanwxp 0 2 100 3", "MOT>", within=60)
    assert re.findall(r"Xponder:(\d+)", heard) == ["1", "2", "3"] * 2
    assert dish.device.board.tuner.transponder == 3
    heard = at(terminal, "az=-180&xponder_style=blank").ask("azscanwxp 0 2 100 3", "MOT>", within=60)
    assert heard.count("\r\n\r\n") == 2


def test_the_time_for_a_transponder_is_a_setting(terminal):
    times = []
    for seconds in (0.1, 1.1):
        dish = at(terminal, f"az=-180&xponder_s={seconds}")
        start = dish.now
        dish.ask("azscanwxp 0 5 100 2", "MOT>", within=60)
        times.append(dish.now - start)
    assert times[1] - times[0] == pytest.approx(10.0, abs=0.1)


def test_elevation_sweeps_and_sweeps_backwards(terminal):
    dish = at(terminal, "el=30&overshoot=0")
    found = points(dish.ask("azscanwxp 1 4 50 1", "MOT>", within=60))
    assert [angle for _, angle, *_ in found] == pytest.approx([3000 + 50 * n for n in range(8)], abs=2)
    back = points(dish.ask("azscanwxp 1 -4 100 1", "MOT>", within=60))
    assert [angle for _, angle, *_ in back] == pytest.approx([3350 - 100 * n for n in range(4)], abs=2)
    assert "out of range" in dish.ask("azscanwxp 1 60 100 1", "MOT>")


def test_azscan_goes_to_and_fro_at_steps_of_elevation(terminal):
    dish = at(terminal, "az=-180&el=40&overshoot=0&azscan_rows=3")
    found = points(dish.ask("azscan 3 2 0", "MOT>", within=60))
    there = [18000, 18100, 18200]
    assert [angle for _, angle, *_ in found] == pytest.approx(there + there[::-1] + there, abs=2)
    assert dish.port.dish.truth().el_deg == pytest.approx(44.0, abs=0.02)
    start = dish.now
    dish.ask("azscan 3 0 500", "MOT>", within=60)
    assert dish.now - start > 1.5


@pytest.mark.parametrize("policy", ["ignore", "abort"])
def test_whether_a_key_ends_a_sweep_is_a_setting(terminal, policy):
    dish = at(terminal, f"az=-180&sweep_key={policy}")
    dish.type("azscan 100\r")
    dish.listen(2.0)
    dish.type("q")
    heard = dish.listen(1.0)
    assert heard.endswith("MOT>") is (policy == "abort")
    assert ("Motor:0" in dish.listen(2.0)) is (policy == "ignore")


@pytest.mark.parametrize(("menu", "line"), [("adc", "scan"), ("mot", "azscanwxp 0 10 100 3"), ("mot", "azscan 10 0 0")])
def test_unhomed_it_goes_for_int_max_and_the_shell_is_gone(terminal, menu, line):
    dish = at(terminal, "unhomed=1", menu=menu)
    assert dish.ask(line) == f"{line}\r\nStep to Position EL angle error: 2147483647\r\n"
    dish.listen(30.0)
    truth = dish.port.dish.truth()
    assert not truth.shell_alive
    assert truth.cable_deg == pytest.approx(23.33, abs=1e-6)  # it ran until the stop
    for key in ("", "q", "reboot", "\x1b", "\x03"):
        assert dish.ask(key) == ""
    dish.device.power_cycle()
    assert dish.listen(30.0).endswith("TRK>")


@pytest.mark.parametrize(
    ("options", "menu", "line", "empty_sky"),
    [
        ("", "adc", "scan 0 2", 235),
        ("", "mot", "azscanwxp 0 2 100 1", 400),
        ("", "mot", "azscan 2 0 0", 400),
        ("&scan_rssi=tuner", "adc", "scan 0 2", 400),
        ("&azscan_rssi=adc", "mot", "azscanwxp 0 2 100 1", 235),
    ],
)
def test_each_sweep_counts_on_its_own_scale(terminal, options, menu, line, empty_sky):
    dish = at(terminal, f"el=58&az=0{options}", menu=menu)
    found = points(dish.ask(line, f"{menu.upper()}>", within=60))
    assert found
    assert all(abs(rssi - empty_sky) < 10 for _, _, rssi, *_ in found)


def test_the_scan_of_adc_counts_as_rssi_beside_it(terminal):
    dish = at(terminal, "el=58&az=0", menu="adc")
    alone = int(dish.ask("rssi", "ADC>").splitlines()[1])
    assert all(abs(rssi - alone) < 10 for _, _, rssi, *_ in points(dish.ask("scan 0 2", "ADC>", within=60)))


def test_the_scan_of_adc_with_arguments(terminal):
    dish = at(terminal, "el=58&az=0", menu="adc")
    found = points(dish.ask("scan 0 2 50", "ADC>", within=60))
    assert len(found) == 5
    assert {delta for *_, delta in found} == {50}
    assert all(225 < rssi < 245 for _, _, rssi, *_ in found)
    unhomed = at(terminal, "unhomed=1", menu="adc")
    assert "Step to Position AZ angle error: 2147483647\r\nADC>" in unhomed.ask("scan 0 10 100", "ADC>")


@pytest.mark.parametrize(("key", "after"), [("q", "\r\nADC>"), ("bdid\r", "\r\nADC>bdid\r\nSTATIONARY\r\nADC>")])
def test_q_or_another_command_ends_the_monitor(terminal, key, after):
    dish = at(terminal, menu="adc")
    dish.type("m\r")
    heard = dish.listen(1.0)
    assert re.fullmatch(r"m\r\n(\rRSSI:  23\d)+", heard)
    dish.type(key)
    assert dish.listen(1.0) == after
