"""Commands that print until a key comes."""

from __future__ import annotations

import pytest


@pytest.mark.parametrize(
    ("command", "word"), [("agc", "RF AGC: "), ("snr", "SNR: "), ("nid", "NID: FFFF"), ("lnbv", "LNB Voltage: 1")]
)
def test_a_stream_goes_on_until_a_key(terminal, command, word):
    dish = terminal()
    dish.ask("dvb", "DVB>")
    dish.type(f"{command}\r")
    heard = dish.listen(5.2)
    assert heard.count(word) == 11
    assert "DVB>" not in heard
    assert dish.ask("").count("DVB>") == 1
    assert dish.listen(5.0) == ""


def test_q_ends_a_stream_and_stays_in_the_menu(terminal):
    dish = terminal()
    dish.ask("dvb", "DVB>")
    dish.ask("agc")
    assert dish.ask("q") == "DVB>\r\nDVB>"
    dish.ask("agc")
    assert dish.ask("rssi 1").startswith("DVB>rssi 1\r\n")


def test_or_the_key_is_read_as_input(terminal):
    dish = terminal("stream_key=keep")
    dish.ask("dvb", "DVB>")
    dish.ask("agc")
    assert dish.ask("q") == "DVB>q\r\nTRK>"


def test_a_key_that_came_before_ends_it_at_once(terminal):
    dish = terminal()
    dish.type("dvb\rnid\r\r")
    assert dish.listen(5.0).count("NID") == 1


def test_lnbdc_lowers_the_voltage_until_the_next_power_on(terminal):
    dish = terminal()
    dish.ask("dvb", "DVB>")
    dish.ask("lnbdc odu", "DVB>")
    dish.type("lnbv\r")
    assert float(dish.listen(0.3).split()[-1]) == pytest.approx(13.0, abs=0.3)
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("dvb", "DVB>")
    dish.type("lnbv\r")
    assert float(dish.listen(0.3).split()[-1]) == pytest.approx(18.0, abs=0.3)


def test_the_monitor_overwrites_its_line(terminal):
    dish = terminal()
    dish.ask("adc", "ADC>")
    dish.type("m\r")
    heard = dish.listen(1.1)
    assert heard.startswith("m\r\n\rRSSI: ")
    assert heard.count("\r\n") == 1
    assert heard.count("\rRSSI:") == 6
    assert dish.ask("") == "\r\nADC>"


def test_a_reboot_ends_a_stream(terminal):
    dish = terminal()
    dish.ask("dvb", "DVB>")
    dish.type("nid\r")
    dish.listen(1.0)
    dish.device.reboot()
    heard = dish.listen(30.0)
    assert "NID" not in heard
    assert heard.endswith("TRK>")
