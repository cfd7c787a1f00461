"""What the console does once the sleep timer, NVS 38, has run out: a setting, as no source tells."""

from __future__ import annotations


def idle(terminal, mode, seconds):
    dish = terminal(f"sleep={mode}")
    dish.ask("mot", "MOT>")
    dish.listen(seconds)
    return dish


def test_by_default_nothing_sleeps(terminal):
    dish = terminal()
    dish.listen(10_000.0)
    assert dish.ask("mot", "MOT>") == "mot\r\nMOT>"


def test_the_first_byte_wakes_it_and_is_lost(terminal):
    dish = idle(terminal, "wake", 419.0)
    assert dish.ask("p", "MOT>").startswith("p\r\n")
    dish.listen(421.0)
    assert dish.ask("xa", "MOT>").startswith("a\r\nAngle[0] = ")
    assert dish.ask("p", "MOT>").startswith("p\r\n")


def test_or_it_is_silent_until_power_on(terminal):
    dish = idle(terminal, "silent", 421.0)
    for key in ("a", "", "q"):
        assert dish.ask(key) == ""
    dish.device.power_cycle()
    assert dish.listen(30.0).endswith("TRK>")
    assert dish.ask("mot", "MOT>") == "mot\r\nMOT>"


def test_the_timer_is_row_38_and_zero_is_never(terminal):
    dish = terminal("sleep=silent")
    dish.ask("nvs", "NVS>")
    dish.ask("e 38 60", "NVS>")
    dish.ask("s", "Success\r\nNVS>")
    dish.listen(100.0)
    assert dish.ask("", "NVS>") == "\r\nNVS>"  # it goes by the value that it read at power-on
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("", "TRK>")
    dish.listen(61.0)
    assert dish.ask("") == ""
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("nvs", "NVS>")
    dish.ask("e 38 0", "NVS>")
    dish.ask("s", "Success\r\nNVS>")
    dish.device.power_cycle()
    dish.listen(10_000.0)
    assert dish.ask("", "TRK>") == "\r\nTRK>"
