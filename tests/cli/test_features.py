"""`features`, `get` and `set`: at a port of their own, and beside a program that has it."""

from __future__ import annotations

import os
from dataclasses import replace

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.paths import Paths
from birdcage.cli import table
from birdcage.protocol.g2.drivers import Drivers
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.g2.protocol import CarryoutG2Protocol
from birdcage.protocol.g2.system import System
from birdcage.protocol.menu_rotator import MenuRotator
from birdcage.rotator.facts import SearchSwitch
from birdcage.rotator.feature import Feature, FeatureKind, Reading, Writer
from birdcage.station import control_client
from birdcage.station.requests import Set


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def rows(text):
    return {line.split()[0]: line for line in text.splitlines()}


def test_what_a_dish_tells_is_listed_without_a_port(run, as_json):
    result = run("features", port="/dev/ttyUSB99", firmware="g2")
    assert result.exit_code == 0, result.stderr
    table = rows(result.stdout)
    assert " ".join(table["rssi"].split()) == "rssi Signal strength, counts read only DVB> rssi 10"
    assert "Greatest azimuth speed, deg/s 0.009 to 65, until restart STEP> mv" in " ".join(
        table["speed.azimuth"].split()
    )
    assert "on, off, from power-up  NVS> d 20" in table["tv_search"]
    lines = result.stdout.splitlines()
    headings = [line for line in lines if not line.startswith(" ")]
    assert headings[:3] == ["Hardware: Identity", "Hardware: Drivers", "Hardware: DIP switches"]
    assert lines.index("Motors: Limits") < lines.index(table["speed.azimuth"]) < lines.index("Motors: Gains")
    told = as_json(run("features", "--json", port="/dev/ttyUSB99", firmware="g2"))
    (search,) = [row for row in told["features"] if row["id"] == "tv_search"]
    assert (search["kind"], search["writer"], search["unit"]) == ("switch", "from power-up", None)
    assert "it moves by itself" in search["hazard"]
    assert (search["page"], search["group"], search["asked"]) == ("settings", "TV search", "NVS> d 20")
    assert search["cost"] == {"lines": 4, "menu": "nvs", "min_interval_s": 0.0, "while_moving": False}


def test_a_narrow_terminal_goes_without_the_question_and_cuts_what_a_feature_is(run, monkeypatch):
    monkeypatch.setattr(table, "room", lambda: 80)
    told = run("features", port="/dev/ttyUSB99", firmware="g2").stdout
    assert max(map(len, told.splitlines())) <= 80
    row = rows(told)["acceleration.elevation"]
    assert "…, deg/s²" in row
    assert "STEP>" not in row
    assert "DVB> rssi 10" in rows(told)["rssi"], "a group that has the room has the question"


def test_the_port_is_asked_where_no_firmware_is_named(run):
    result = run("features", port="sim:hal205", firmware="")
    assert result.exit_code == 0, result.stderr
    assert "at once" in rows(result.stdout)["end_tv_search"]
    missing = run("features", port="/dev/ttyUSB99", firmware="")
    assert (missing.exit_code, missing.stdout) == (3, "")
    assert missing.stderr.startswith("/dev/ttyUSB99 does not exist")


def test_a_port_where_nothing_answers_needs_the_firmware_named(run):
    main, line = os.openpty()
    silent = run("features", port=os.ttyname(line), firmware="")
    assert (silent.exit_code, silent.stdout) == (2, "")
    assert "Name the firmware with --firmware" in silent.stderr
    os.close(main)
    os.close(line)


def test_features_are_read(run, as_json):
    result = run("get", "version", "speed.azimuth", "tv_search")
    assert result.exit_code == 0, result.stderr
    lines = [line.split(None, 1) for line in result.stdout.splitlines()]
    assert lines == [["version", "02.02.48"], ["speed.azimuth", "64.998 deg/s"], ["tv_search", "off"]]
    told = as_json(run("get", "rssi", "settings", "--json"))
    assert told["port"] == "sim:g2"
    assert told["readings"]["rssi"]["unit"] == "counts"
    assert any("Disable Tracker" in line for line in told["readings"]["settings"]["value"])


def test_what_a_dish_does_not_tell_is_a_dash(run, as_json, monkeypatch):
    monkeypatch.setattr(System, "fields", lambda _system: {"Software": "02.02.48"})
    result = run("get", "version", "antenna_id")
    assert result.exit_code == 1
    assert [line.split() for line in result.stdout.splitlines()] == [["version", "02.02.48"], ["antenna_id", "-"]]
    assert as_json(run("get", "antenna_id", "--json"))["readings"] == {"antenna_id": None}


def test_what_a_dish_lacks_is_an_error(run):
    result = run("get", "rssi", port="sim:carryout", firmware="carryout")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "has no feature rssi that can be read. Nothing was sent. `birdcage features`" in result.stderr


def test_a_feature_is_set_and_read_back(run, pty_dish):
    result = run("set", "speed.azimuth", "10", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert result.stdout.split() == ["speed.azimuth", "9.999", "deg/s"]
    assert "mv 0 1111" in pty_dish.lines()
    assert [line for line in pty_dish.moves() if line != "a"] == []


@pytest.mark.parametrize(("words", "code", "sentence"), [
    (("speed.azimuth", "70"), 4, "5 deg/s beyond its limit of 65 deg/s. Nothing was sent. Give 0.009 to 65"),
    (("speed.azimuth", "2000"), 4, "2000 deg/s is 1935 deg/s beyond"),
    (("speed.azimuth", "-5"), 4, "-5 deg/s is 5.009 deg/s beyond its limit of 0.009 deg/s"),
    (("speed.azimuth", "--fast"), 2, "No such option"),
    (("speed.azimuth", "fast"), 2, "Give a number, in deg/s"),
    (("speed.azimuth",), 2, "Give a value"),
    (("tv_search", "maybe"), 2, "Give on or off"),
    (("tv_search", "on"), 2, "Give --yes to do it"),
    (("rssi", "3"), 1, "no feature rssi that can be set"),
])  # fmt: skip
def test_what_is_not_set_says_why_and_sends_nothing(run, pty_dish, words, code, sentence):
    result = run("set", *words, port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (code, "")
    assert sentence in result.stderr
    assert not [line for line in pty_dish.lines() if line.startswith(("e ", "mv "))]


def test_what_is_done_and_over_is_said_to_be_done(run):
    result = run("set", "end_tv_search", port="sim:hal205", firmware="hal205")
    assert result.exit_code == 0, result.stderr
    assert result.stdout.split() == ["end_tv_search", "done"]


def test_a_hazard_is_named_and_agreed_to(run, pty_dish):
    asked = run("set", "tv_search", "on", port=pty_dish.path)
    assert "On: it homes and searches then: it moves by itself." in asked.stderr
    result = run("set", "tv_search", "on", "--yes", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert result.stdout.split() == ["tv_search", "on"]
    assert "e 20 0" in pty_dish.lines()
    assert list(Paths.default().backups.iterdir()), "a copy of all settings is kept"


def test_a_dish_that_never_searches_owes_no_answer_about_it(run, monkeypatch):
    never = replace(CARRYOUT_G2, search_switch=SearchSwitch.NEVER_SEARCHES, search_setting=None)
    monkeypatch.setattr(CarryoutG2Protocol, "model", never)
    refused = run("init", "--disable-search", "--yes")
    assert refused.exit_code == 2
    assert "This dish has no TV search." in refused.stderr
    result = run("init", "--json")
    assert '"search": "none"' in result.stdout
    assert "TV search" not in result.stderr
    ready = run("ready").stdout
    assert "this dish has none" in next(line for line in ready.splitlines() if "TV search" in line)


def test_a_program_that_has_the_port_is_asked_instead(run, as_json, pty_dish, owner):
    assert "speed.azimuth" in rows(run("features", port=pty_dish.path, firmware="").stdout)
    told = as_json(run("get", "version", "speed.elevation", "--json", port=pty_dish.path))
    assert told["port"] == pty_dish.path
    assert told["readings"]["version"]["value"] == "02.02.48"
    assert owner.station.state.readings["version"].value == "02.02.48"
    result = run("set", "speed.elevation", "5", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert owner.station.state.readings["speed.elevation"].value == pytest.approx(5.0, abs=0.02)
    assert owner.station.state.holder is None


def test_what_that_program_refuses_is_said_with_its_own_code(run, pty_dish, owner):
    beyond = run("set", "speed.elevation", "50", port=pty_dish.path)
    assert beyond.exit_code == 4
    assert "beyond its limit of 45 deg/s" in beyond.stderr
    lacking = run("get", "rainfall", port=pty_dish.path)
    assert lacking.exit_code == 1
    assert "no feature rainfall" in lacking.stderr
    search = run("set", "tv_search", "on", "--yes", port=pty_dish.path)
    assert search.exit_code == 0, search.stderr
    assert owner.station.state.holder is None, "control is not left with a command that has ended"


def test_a_program_that_has_not_met_its_dish_lists_nothing(run, pty_dish, owner):
    owner.station._store.change(dish=None)
    for words in (("features",), ("set", "speed.azimuth", "5")):
        result = run(*words, port=pty_dish.path)
        assert (result.exit_code, result.stdout) == (3, "")
        assert "does not know yet which dish it is" in result.stderr


def test_who_is_interrupted_is_not_told_that_nothing_was_done(run, pty_dish, owner, monkeypatch):
    asked = control_client.call_owner

    def interrupted(owner, request, by):
        told = asked(owner, request, by)
        if isinstance(request, Set):
            raise KeyboardInterrupt
        return told

    monkeypatch.setattr(control_client, "call_owner", interrupted)
    result = run("set", "speed.elevation", "5", port=pty_dish.path)
    assert (result.exit_code, result.stderr) == (130, "Whether speed.elevation was set is not known.\n")
    assert owner.station.state.readings["speed.elevation"].value == pytest.approx(5.0, abs=0.02)


def test_what_can_only_be_set_is_shown_as_that(run, monkeypatch):
    """The dish has taken it, and can't be asked again."""
    lamp = Feature("lamp", "Lamp", kind=FeatureKind.SWITCH, writer=Writer.UNTIL_RESTART, told=False)
    model = replace(CARRYOUT_G2, features={**CARRYOUT_G2.features, "lamp": lamp})
    monkeypatch.setattr(CarryoutG2Protocol, "model", model)
    monkeypatch.setattr(MenuRotator, "write", lambda dish, _id, on: Reading(on, "", 0.0, dish.clock.utc()))
    assert rows(run("features").stdout)["lamp"].endswith("on, off, until restart, not told")
    result = run("set", "lamp", "on")
    assert result.stdout.split(None, 1) == ["lamp", "on: the dish took it, and can't be asked for it\n"]
    asked = run("get", "lamp")
    assert (asked.exit_code, asked.stdout) == (1, "")
    assert "has no feature lamp that can be read. Nothing was sent." in asked.stderr


def test_what_reading_itself_changes_is_asked_about_and_yes_agrees(run, as_json):
    refused = run("get", "even_level", "--port", "sim:g2?seed=1", "--firmware", "g2")
    assert refused.exit_code == 2
    assert "switches the LNB supply to 18 V and to 13 V" in refused.stderr
    assert "Give --yes" in refused.stderr
    told = as_json(
        run("get", "even_level", "odd_level", "--yes", "--json", "--port", "sim:g2?seed=1", "--firmware", "g2")
    )
    assert set(told["readings"]) == {"even_level", "odd_level"}
    assert None not in told["readings"].values()


def test_a_page_is_read_menu_by_menu_and_shown_under_its_headings(run, as_json, pty_dish):
    result = run("get", "--page", "hardware", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    lines = result.stdout.splitlines()
    assert lines[:2] == ["Hardware: Identity", f"  {'version':24} 02.02.48"]
    assert f"  {'driver.elevation':24} OK" in lines[lines.index("Hardware: Drivers") : lines.index("Hardware: Pins")]
    assert "    E0  1  SPI1_PCS1 A3981 #2 chip select (EL motor)" in lines[lines.index("  pins.e") :]
    menus = ["os", "adc", "a3981", "dipswitch", "gpio", "eeprom", "mot"]
    entered = [line for line in pty_dish.lines() if line in menus]
    entered = entered[entered.index("os") :]
    assert list(dict.fromkeys(entered)) == menus
    assert len(entered) == len(menus) + 1, "each once; in `dipswitch` the command is called so, too"
    sent = [line for line in pty_dish.lines() if line in ("regs", "id", "diag", "ee 0", "ee 15")]
    assert sent == ["id", "diag", "regs", "ee 0", "ee 15"], "each once"
    told = as_json(run("get", "--page", "motors", "--group", "GAINS", "--json", port=pty_dish.path))
    assert set(told["readings"]) == {name for name in CARRYOUT_G2.features if _is_of(name, "motors", "Gains")}
    assert None not in told["readings"].values()


def _is_of(name, page, group):
    feature = CARRYOUT_G2.features[name]
    return (feature.page.value, feature.group) == (page, group) and feature.is_readable


def test_of_a_page_nothing_is_read_that_needs_consent(run, pty_dish):
    result = run("get", "--page", "receiver", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    said = "Not read, because reading changes something: transponders, transponders.extended, even_level, odd_level."
    assert said in result.stderr
    assert not {"table", "tablex", "rssits"} & set(pty_dish.lines())
    assert f"  {'lnb_id':24} no answer" in result.stdout.splitlines()
    agreed = run("get", "--page", "receiver", "--yes", port=pty_dish.path)
    assert agreed.exit_code == 0, agreed.stderr
    assert {"table", "tablex", "rssits"} <= set(pty_dish.lines())
    assert "  transponders" in agreed.stdout.splitlines()


@pytest.mark.parametrize(("words", "code", "sentence"), [
    (("--page", "motors", "rssi"), 2, "not both"),
    ((), 2, "Give the names of features, or --page or --group."),
    (("--page", "engine"), 2, "'engine' is not one of"),
    (("--page", "motors", "--group", "pins"), 1, "This dish tells nothing of motors: pins. It has Hardware: Identity,"),
])  # fmt: skip
def test_what_no_page_has_is_an_error(run, pty_dish, words, code, sentence):
    result = run("get", *words, port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (code, "")
    assert sentence in result.stderr


def test_a_machine_with_little_has_a_page_with_little(run):
    result = run("get", "--page", "settings", port="sim:carryout", firmware="carryout")
    assert result.exit_code == 0, result.stderr
    assert result.stdout.splitlines() == ["Settings: Elevation", f"  {'ceiling':24} 73 deg"]
    lacking = run("get", "--page", "motors", port="sim:carryout", firmware="carryout")
    assert lacking.exit_code == 1
    assert "It has Settings: Elevation." in lacking.stderr


def test_what_is_refused_is_a_dash_and_the_rest_is_read(run, monkeypatch):
    def refused(_drivers):
        raise CommandRefused("The drivers are off.")

    monkeypatch.setattr(Drivers, "faults", refused)
    result = run("get", "driver.azimuth", "torque.azimuth")
    assert result.exit_code == 1
    assert [line.split() for line in result.stdout.splitlines()] == [["driver.azimuth", "-"], ["torque.azimuth", "LOW"]]
    alone = run("get", "driver.azimuth")
    assert (alone.exit_code, alone.stdout, alone.stderr) == (1, "", "The drivers are off.\n")


def test_the_old_value_is_said_and_how_to_put_it_back(run, as_json, pty_dish):
    result = run("set", "kp.azimuth", "200", "--yes", port=pty_dish.path)
    assert (result.exit_code, result.stdout.split()) == (0, ["kp.azimuth", "200"])
    assert "It was 250. Undo: birdcage set kp.azimuth 250\n" in result.stderr
    result = run("set", "speed.elevation", "11.125", port=pty_dish.path)
    undo = result.stderr.split("Undo: birdcage set ")[1].split()
    assert undo == ["speed.elevation", "45"]
    result = run("set", *undo, port=pty_dish.path)
    assert "Undo: birdcage set speed.elevation 11.1201923" in result.stderr, "as the dish takes it: 771 microsteps/s"
    assert "mv 1 771" in pty_dish.lines()
    run("set", *result.stderr.split("Undo: birdcage set ")[1].split(), port=pty_dish.path)
    assert [line for line in pty_dish.lines() if line.startswith("mv 1")] == ["mv 1 771", "mv 1 3120", "mv 1 771"]
    told = as_json(run("set", "kp.azimuth", "250", "--yes", "--json", port=pty_dish.path))
    assert (told["before"]["value"], told["readings"]["kp.azimuth"]["value"]) == (200.0, 250.0)
    again = run("set", "kp.azimuth", "250", "--yes", port=pty_dish.path)
    assert "Undo" not in again.stderr, "nothing has changed"


def test_a_program_that_has_the_port_tells_the_old_value_too(run, pty_dish, owner):
    result = run("set", "kv.elevation", "60", "--yes", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert "It was 50. Undo: birdcage set kv.elevation 50\n" in result.stderr
    told = run("get", "--page", "hardware", port=pty_dish.path)
    assert told.exit_code == 0, told.stderr
    assert "    E0  1  SPI1_PCS1 A3981 #2 chip select (EL motor)" in told.stdout.splitlines()
    lines = pty_dish.lines()
    assert [lines.count(each) for each in ("regs", "diag", "id")][:2] == [1, 1]


def test_what_a_message_means_is_said_before_it_goes_out(run, pty_dish):
    asked = run("set", "diseqc", "E0 10 38 F4", port=pty_dish.path)
    assert asked.exit_code == 2
    assert "any LNB, switch or SMATV; write to port group 0 (committed switch): position B, option A" in asked.stderr
    assert "polarisation, band or input may change" in asked.stderr
    wrong = run("set", "diseqc", "E0 GG", "--yes", port=pty_dish.path)
    assert wrong.exit_code == 2
    assert "'GG' is no byte in hex" in wrong.stderr
    assert not [line for line in pty_dish.lines() if line.startswith("send")]
    sent = run("set", "diseqc", "E0 10 38 F4", "--yes", port=pty_dish.path)
    assert sent.exit_code == 0, sent.stderr
    assert sent.stdout.split(None, 1)[1] == "E0 10 38 F4 sent; the dish printed: Tx: E0 10 38 F4\n"
