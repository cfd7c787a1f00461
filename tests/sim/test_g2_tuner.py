"""What the tuner hears: level, lock, SNR and network, from the sky and from where the dish really points."""

from __future__ import annotations

import statistics

import pytest
from birdcage.sim.almanac import geostationary
from birdcage.sim.g2.tuner import NETWORKS, plan


def pointed(terminal, slot, options=""):
    az, el = geostationary(slot, 39.1, -95.7)
    dish = terminal(f"az={az - 360}&el={el}" + (f"&{options}" if options else ""))
    return dish.device.board


def empty(terminal, options=""):
    return terminal("az=0&el=58" + (f"&{options}" if options else "")).device.board


def test_the_plan_of_the_transponders():
    assert plan(1).frequency_khz == 974_000
    assert plan(15).frequency_khz == pytest.approx(1_178_000, abs=500)  # the 1178 MHz that are noted
    assert (plan(15).polarity, plan(15).volts) == ("V", 13.0)
    assert (plan(16).polarity, plan(16).volts) == ("H", 18.0)


def test_an_empty_sky_locks_nothing(terminal):
    board = empty(terminal)
    board.tuner.lnb_volts = 13.0
    heard = [board.tuner.read(board.now_s) for _ in range(200)]
    assert statistics.fmean(one.rssi for one in heard) == pytest.approx(400, abs=0.5)
    assert 0.5 < statistics.pstdev(one.rssi for one in heard) < 2.0
    assert {(one.locked, one.snr_db) for one in heard} == {(False, 0.0)}
    assert board.tuner.read(board.now_s).network == 0xFFFF


def test_a_satellite_locks_at_the_voltage_of_the_transponder(terminal):
    board = pointed(terminal, -119.0)
    assert board.tuner.lnb_volts == 18.0
    assert not board.tuner.read(board.now_s).locked  # 15 is vertical
    board.tuner.select(16)
    heard = board.tuner.read(board.now_s)
    assert heard.locked
    assert heard.rssi > 520
    assert heard.snr_db == pytest.approx((heard.rssi - 401) / 15, abs=0.2)
    assert board.tuner.read(board.now_s).network == NETWORKS[-119.0]
    board.tuner.lnb_volts = 13.0
    assert board.tuner.read(board.now_s).network == 0xFFFF
    board.tuner.select(15)
    assert board.tuner.read(board.now_s).locked


def test_lock_may_not_care_for_the_voltage(terminal):
    board = pointed(terminal, -119.0, "lock_polarity=0")
    assert board.tuner.read(board.now_s).locked


def test_a_slot_without_network_locks_all_the_same(terminal):
    board = pointed(terminal, -101.0, "lock_polarity=0")
    assert board.tuner.read(board.now_s).locked
    assert board.tuner.read(board.now_s).network == 0xFFFF


def test_the_same_seed_hears_the_same(terminal):
    first, second, other = empty(terminal), empty(terminal), empty(terminal, "seed=2")
    series = [[board.tuner.read(board.now_s).rssi for _ in range(30)] for board in (first, second, other)]
    assert series[0] == series[1] != series[2]


def test_power_on_forgets(terminal):
    board = empty(terminal, "transponder=3")
    board.tuner.select(20)
    board.tuner.edit(symbol_rate_ksps=21_500)
    board.tuner.lnb_volts = 13.0
    assert board.tuner.channel.symbol_rate_ksps == 21_500
    board.power_on()
    assert (board.tuner.transponder, board.tuner.lnb_volts) == (3, 18.0)
    board.tuner.select(20)
    assert board.tuner.channel == plan(20)


@pytest.mark.parametrize("number", [0, 33, -1])
def test_there_are_32_transponders(terminal, number):
    with pytest.raises(ValueError, match=str(number)):
        empty(terminal).tuner.select(number)


def test_a_receiver_that_is_off_hears_nothing(terminal):
    board = pointed(terminal, -119.0, "lock_polarity=0")
    board.tuner.on = False
    assert board.tuner.read(board.now_s).rssi == 0
    assert not board.tuner.read(board.now_s).locked


def test_13_volts_may_shift_the_level_but_not_the_satellite(terminal):
    board = empty(terminal, "lnb_13v_counts=-50&rssi_noise=0")
    before = board.tuner.read(board.now_s).rssi
    board.tuner.lnb_volts = 13.0
    assert board.tuner.read(board.now_s).rssi == before - 50


@pytest.mark.parametrize(
    ("change", "locks"),
    [
        ({"frequency_khz": 1_180_000}, True),
        ({"frequency_khz": 1_185_000}, False),
        ({"symbol_rate_ksps": 21_500}, False),
    ],
)
def test_a_channel_beside_the_transponder_does_not_lock(terminal, change, locks):
    board = pointed(terminal, -119.0, "lock_polarity=0")
    board.tuner.edit(**change)
    assert board.tuner.read(board.now_s).locked is locks


def test_it_counts_what_it_reads(terminal):
    board = pointed(terminal, -119.0)
    board.tuner.lnb_volts = 13.0
    board.tuner.read(board.now_s)
    board.tuner.lnb_volts = 18.0
    board.tuner.read(board.now_s)
    tally = board.tuner.tally
    assert (tally.reads, tally.no_signal, tally.glitches) == (2, 1, 1)
    assert tally.networks == {NETWORKS[-119.0]: 1}


def test_a_survey_looks_at_the_voltage_of_the_transponder_and_goes_back(terminal):
    board = pointed(terminal, -119.0)
    assert all(board.tuner.survey(number, board.now_s).locked for number in (2, 32, 31))
    assert (board.tuner.transponder, board.tuner.lnb_volts) == (15, 18.0)
