"""Settings memory, power and the boot log."""

from __future__ import annotations

ORDER = (
    "Bootloader v1.01",
    "System=12Inch",
    "EXTENDED_DVB_DEBUG ENABLED",
    "Enabled LNB STB",
    "Ant ID - 12-IN G2",
    "wrap_min:-42333 wrap_max:2333",
    "Antenna Facing Front",
    "TRK>",
)


def boot(dish):
    return dish.listen(30.0)


def test_boot_log_in_order_and_homed(terminal):
    dish = terminal("boot=1&nvs20=0")
    early = dish.listen(2.0)
    assert "Bootloader" in early
    assert "TRK>" not in early
    log = early
    while "Antenna Facing Front" not in log:
        log += dish.listen(0.05)
    truth = dish.port.dish.truth()
    assert truth.homed
    assert (round(truth.az_deg, 2), truth.el_deg) == (0.01, 65.0)
    log += boot(dish)
    places = [log.index(text) for text in ORDER]
    assert places == sorted(places)
    assert "Boot Complete\r\n" in log
    assert "Loc Startup: IDU NOT Present\r\n" in log
    assert log.endswith("TRK>")


def test_with_nvs_20_true_nothing_is_homed(terminal):
    dish = terminal("boot=1")
    log = boot(dish)
    assert "wrap_min" not in log
    assert "Antenna Facing Front" not in log
    assert log.endswith("TRK>")
    dish.ask("mot", "MOT>")
    assert "2147483647" in dish.ask("a", "MOT>")


def test_nvs_20_takes_effect_at_the_next_power_on_and_only_if_saved(terminal):
    dish = terminal("nvs20=0")
    dish.ask("nvs", "NVS>")
    dish.ask("e 20 1", "NVS>")
    dish.device.power_cycle()
    assert "Antenna Facing Front" in boot(dish)  # it was not saved
    dish.ask("nvs", "NVS>")
    dish.ask("e 20 1", "NVS>")
    dish.ask("s", "Success\r\nNVS>")
    row = dish.ask("d 20", "NVS>").splitlines()[-2]
    assert row.split()[-3:] == ["TRUE", "TRUE", "FALSE"]
    dish.device.power_cycle()
    assert "Antenna Facing Front" not in boot(dish)


def test_limits_come_from_the_settings_memory(terminal):
    dish = terminal("nvs20=0")
    dish.ask("nvs", "NVS>")
    dish.ask("e 101 30", "NVS>")
    dish.ask("e 80 10", "NVS>")
    dish.ask("s", "Success\r\nNVS>")
    dish.ask("q", "TRK>")
    dish.ask("reboot", "TRK>", within=40.0)
    dish.ask("mot", "MOT>")
    assert "out of range" in dish.ask("a 1 25", "MOT>")
    assert "Max Vel [0] = 10.00" in dish.ask("mv", "MOT>")


def test_reading_writing_and_refusing_rows(terminal):
    dish = terminal()
    dish.ask("nvs", "NVS>")
    assert dish.ask("e 101", "NVS>").splitlines()[1].split() == ["101)", "Minimum", "Elevation", "Angle", "18.00"]
    assert "Invalid parameter." in dish.ask("e 50", "NVS>")
    assert "Invalid parameter." in dish.ask("e 101 high", "NVS>")
    assert "Invalid parameter." in dish.ask("d 50", "NVS>")
    assert "0x00000007" in dish.ask("d", "NVS>")
    assert "+0" in dish.ask("d 26", "NVS>")


def test_unknown_input_reads_the_next_row(terminal):
    dish = terminal()
    dish.ask("nvs", "NVS>")
    assert "  0) Log ID's" in dish.ask("foo", "NVS>")
    assert "  1) Log Device" in dish.ask("bar", "NVS>")


def test_reboot_in_mid_move(terminal):
    dish = terminal()
    dish.ask("mot", "MOT>")
    dish.ask("a 0 200", "MOT>")
    dish.listen(1.0)
    dish.device.reboot()
    stopped = dish.port.dish.truth()
    assert not stopped.moving
    assert not stopped.homed
    assert "Bootloader" in dish.listen(10.0)
    assert dish.port.dish.truth().az_deg == stopped.az_deg
    assert dish.port.dish.truth().menu == "root"


def test_no_power_no_answer(terminal):
    dish = terminal()
    dish.device.power_off()
    assert dish.ask("mot") == ""
    assert not dish.port.dish.truth().powered
    dish.device.power_on()
    assert boot(dish).endswith("TRK>")


def heard_with_times(dish, seconds=30.0):
    start, heard = dish.now, []
    while dish.now < start + seconds:
        text = dish.listen(0.1)
        if text:
            heard.append((round(dish.now - start, 3), text))
    return heard


def test_the_log_keeps_its_times_whatever_was_going_on(terminal):
    quiet = terminal()
    quiet.device.reboot()
    expected = heard_with_times(quiet)
    homing = terminal()
    homing.ask("mot", "MOT>")
    homing.type("h 0\r")
    homing.listen(0.4)
    homing.device.reboot()
    assert heard_with_times(homing) == expected
    typed = terminal("latency_min=0&latency_max=0&echo=0")
    typed.type("reboot\r")
    assert heard_with_times(typed) == expected


def test_the_tv_search_moves_the_dish_until_it_hears_a_satellite(terminal):
    dish = terminal("boot=1&nvs20=0")
    boot(dish)
    dish.listen(60.0)
    found = dish.port.dish.truth()
    assert not found.moving
    dish.ask("dvb", "DVB>")
    assert int(dish.ask("rssi 20", "DVB>").split("avg: ")[1].split()[0]) > 460
    deaf = terminal("boot=1&nvs20=0&lat=89")
    boot(deaf)
    deaf.device.stall(0)
    deaf.listen(10.0)
    deaf.device.stall(0, blocked=False)
    places = set()
    for _ in range(10):
        deaf.listen(5.0)
        places.add(round(deaf.port.dish.truth().az_deg))
        assert 17.9 < deaf.port.dish.truth().el_deg < 65.1
    assert len(places) > 5
    deaf.device.power_off()
    still = deaf.port.dish.truth()
    deaf.listen(30.0)
    assert deaf.port.dish.truth() == still


def test_without_a_search_nothing_moves_after_power_on(terminal):
    dish = terminal("boot=1")
    boot(dish)
    still = dish.port.dish.truth()
    dish.listen(120.0)
    assert dish.port.dish.truth() == still


def test_the_row_that_comes_next_is_forgotten_at_power_on(terminal):
    dish = terminal()
    dish.ask("nvs", "NVS>")
    dish.ask("foo", "NVS>")
    dish.device.power_cycle()
    boot(dish)
    dish.ask("nvs", "NVS>")
    assert "  0) Log ID's" in dish.ask("foo", "NVS>")


def test_an_edit_is_in_ram_until_saved_and_counts_from_power_on(terminal):
    dish = terminal("nvs20=0")
    dish.ask("nvs", "NVS>")
    dish.ask("e 102 60", "NVS>")
    assert dish.ask("d 102", "NVS>").split()[-4:-1] == ["60.00", "65.00", "65.00"]
    dish.ask("s", "Success\r\nNVS>")
    assert dish.ask("d 102", "NVS>").split()[-4:-1] == ["60.00", "60.00", "65.00"]
    dish.ask("q", "TRK>")
    dish.ask("mot", "MOT>")
    assert "Max: 65.00" in dish.ask("elminmaxhome", "MOT>")
    dish.device.power_cycle()
    boot(dish)
    dish.ask("mot", "MOT>")
    assert "Max: 60.00" in dish.ask("elminmaxhome", "MOT>")
