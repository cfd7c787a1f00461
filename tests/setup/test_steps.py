"""Single steps: what goes on the wire, what is kept, and what is refused."""

from __future__ import annotations

import pytest
from birdcage.base.config import edit
from birdcage.base.errors import BirdcageError
from birdcage.setup.step import NoSuchChoice
from birdcage.station.known import PortInfo

PLACE = {"latitude_deg": "39.1", "longitude_deg": "-95.7", "height_m": "250"}


class TestLink:
    def test_keeps_port_speed_and_adapter(self, house):
        house.choose("link", "keep")
        settings = house.file()
        assert (settings.dish.port, settings.dish.baud) == ("/dev/ttyUSB0", 115200)
        assert settings.link.usb_identity == "0403:6001:A5"
        assert house.view("link").evidence.startswith("ttyUSB0, FTDI, 115200 8N1, answers in ")
        shown = set()
        for _ in range(50):
            house.run(0.2)
            shown.add(house.view("link").evidence)
        assert len(shown) == 1, "the figure is of when it was kept: one that changes makes the list jump"

    def test_changes_over_to_another_port(self, house):
        house.choose("link", "other", port="/dev/ttyUSB7")
        house.run(3)
        assert house.marks()["link"] == "failed"
        house.choose("link", "port-1")
        assert house.marks()["link"] == "done"
        assert house.file().dish.port == "/dev/ttyUSB0"

    def test_a_port_that_is_not_there_is_not_kept(self, house):
        house.choose("link", "other", port="/dev/ttyUSB7")
        assert house.marks()["link"] == "failed"
        assert "/dev/ttyUSB7" in house.view("link").evidence
        assert house.file().dish.port is None

    def test_without_a_port_it_says_what_to_plug_in_and_offers_no_remedy(self, build):
        house = build(port="")
        house.plugged = []
        house.run(3)
        view = house.view("link")
        assert (view.mark.value, view.evidence) == ("todo", "No port set.")
        told = " ".join(view.words)
        assert "No serial port found. Plug the adapter into a USB port" in told
        assert "The list refreshes every 2 seconds." in told
        assert "four signal wires" in told
        assert house.setup.causes() == ()
        for remedy in ("sudo", "chmod", "Choose the port"):
            assert remedy not in told
        house.plugged = [PortInfo("/dev/ttyUSB0", None, "FT232R USB UART", "0403:6001", "A5", "1-1")]
        house.run(2.5)
        view = house.view("link")
        assert "/dev/ttyUSB0, FTDI" in [choice.label for choice in view.choices]
        assert " ".join(view.words).startswith("Choose the port of the RS-422 adapter.")
        assert "sudo" not in " ".join(view.words)

    def test_no_speed_answers(self, house):
        house.device.power_off()
        house.until(lambda: house.marks()["link"] == "failed")
        assert next(choice.key for choice in house.view("link").choices if choice.name == "probe") == "enter"
        house.choose("link", "probe")
        again = next(choice for choice in house.view("link").choices if choice.name == "probe")
        assert (again.key, again.label) == ("enter", "Listen at other speeds again")
        assert "Connect" not in [choice.label for choice in house.view("link").choices]
        assert any("silence" in words for words in house.view("link").words)

    def test_a_dish_that_boots_is_heard_by_its_text(self, build):
        house = build("g2?boot=1&nvs20=0&home_fails=1")
        edit(house.paths.config_file, {"dish.baud": 57600})
        house.start()
        house.device.power_off()
        house.until(lambda: any(choice.name == "probe" for choice in house.view("link").choices))
        house.device.power_cycle(0.6)  # it then prints while 115200 is listened to
        house.choose("link", "probe")
        assert "text" in next(words for words in house.view("link").words if words.startswith("Seen"))
        house.choose("link", "connect")
        assert house.file().dish.baud == 115200


class TestSearch:
    def test_that_is_off_is_seen_to_be_off(self, house):
        assert house.marks()["search"] == "done"
        assert not any(line.startswith("e 20") for line in house.lines())

    def test_a_power_cycle_that_nobody_noticed_can_be_told(self, build):
        house = build("g2?nvs20=0&unhomed=1").up()
        house.run(8)
        assert "NVS 20 is FALSE" in house.view("search").evidence
        marks = []
        house.setup.choose("search", "off")
        while house.setup.busy:
            house.session.step(0.01)
            marks.append(house.marks()["search"])
            house.setup.tick()
        assert set(marks) == {"todo"}
        house.run(3)
        assert house.marks()["search"] == "todo"
        house.kill()
        house.start().run(8)
        assert house.marks()["search"] == "todo"
        assert "waits for the dish to be switched off and on" in house.view("search").evidence
        house.choose("search", "cycled")
        house.until(lambda: house.marks()["search"] == "done")
        assert "backup nvs-g2-" in house.view("search").evidence

    def test_a_restart_is_acknowledged_by_a_person(self, build):
        house = build("g2?nvs20=0&unhomed=1").up()
        house.run(8)
        house.choose("search", "off")
        house.device.power_cycle()
        house.until(lambda: house.state.fault is not None)
        house.run(15)
        assert house.marks()["search"] == "todo"
        house.choose("search", "release")
        house.until(lambda: house.marks()["search"] == "done")

    def test_a_dish_that_is_switched_off_because_it_was_asked_for_is_no_trouble_of_the_link(self, build):
        house = build("g2?nvs20=0&unhomed=1").up()
        house.run(8)
        house.choose("link", "keep")
        house.choose("search", "off")
        house.kill()
        house.start().run(8)
        assert house.setup.current == "search"
        house.device.power_cycle(6.0)
        seen = set()
        while house.state.fault is None or not house.view("search").choices:
            house.run(0.1)
            seen.add(house.setup.current)
        assert seen == {"search"}
        assert "started anew" in house.view("search").words[0]
        assert [choice.key for choice in house.view("search").choices] == ["enter"]
        house.choose("search", "release")
        house.until(lambda: house.setup.current == "home")
        assert house.state.held is None

    def test_silence_alone_is_no_power_cycle(self, build):
        house = build("g2?nvs20=0&unhomed=1").up()
        house.run(8)
        house.choose("link", "keep")
        house.choose("search", "off")
        house.device.unplug()
        house.run(5)
        house.device.plug()
        house.run(20)
        assert house.view("link").mark.value == "done"
        assert house.marks()["search"] == "todo"

    def test_a_boot_that_is_seen_while_nobody_was_met_yet_counts(self, build):
        house = build("g2?nvs20=0&unhomed=1").up()
        house.run(8)
        house.choose("search", "off")
        house.kill()
        house.device.power_cycle(0.5)
        house.start()
        house.until(lambda: house.marks()["search"] == "done")

    def test_a_dish_that_searches_is_quietened(self, build):
        house = build("g2?boot=1&nvs20=0&lat=-60")
        house.run(40)
        assert house.state.fault is not None, house.state
        assert house.state.fault.reason == "moved"
        house.choose("search", "off")
        assert any(line == "e 20 1" for line in house.lines())

    def test_stop_is_not_released_by_the_way(self, build):
        house = build("g2?nvs20=0&unhomed=1").up()
        house.run(8)
        house.station.stop("you")
        house.run(1)
        house.choose("search", "off")
        assert "HELD by you since" in house.view("search").evidence
        assert house.state.held is not None
        assert not any(line.startswith("e 20") for line in house.lines())


class TestHome:
    def test_is_a_fact_of_the_dish_and_of_no_file(self, house):
        house.setup.clear()
        assert any("end stops, up to 30 s. Keep" in words for words in house.view("home").words), "as its question says"
        house.choose("home", "home")
        assert house.marks()["home"] == "done"
        assert house.file().setup.home is None
        house.device.reboot()
        house.run(12)
        assert house.marks()["home"] == "todo"
        assert "not homed" in house.view("home").evidence


class TestFeed:
    def test_another_one(self, house):
        house.choose("feed", "other", name="L-band helix", beam_deg="12,5", lo_hz="9750 MHz", az_offset_deg="0.5")
        feed = house.file().active_feed
        assert (feed.beam_deg, feed.lo_hz, feed.az_offset_deg, feed.stow_allowed) == (12.5, 9.75e9, 0.5, False)
        assert (house.state.feed_name, house.state.beam.az_deg, house.state.stow_allowed) == (
            "L-band helix",
            12.5,
            False,
        )
        assert house.view("feed").evidence == (
            "L-band helix, beam 12.5° x 12.5° entered by hand, LO 9750 MHz, offset +0.50/+0.00 deg, stow locked"
        )

    def test_the_stock_feed_says_both_widths_and_where_they_come_from(self, house):
        view = house.view("feed")
        assert view.choices[0].label == "Stock LNB, 12.2 to 12.7 GHz, beam 5.5° x 5.5° theory"
        assert (
            "Stock beam: 5.5° x 5.5° from reflector and frequency; 6.4° x 6.3° measured in counts: upper bound."
            in view.words
        )
        house.choose("feed", "stock")
        assert house.state.beam.size == "5.5° x 5.5°"

    def test_a_band_makes_the_beam_and_two_widths_go_before_it(self, house):
        house.choose("feed", "other", name="helix", band="1670 to 1710 MHz")
        assert house.state.beam.words == "40.7° x 40.7° from reflector and frequency"
        assert "helix, 1.67 to 1.71 GHz, beam 40.7° x 40.7° theory" in [
            each.label for each in house.view("feed").choices
        ]
        house.choose("feed", "other", name="mine", band="12.2-12.7 GHz", beam_deg="2,1 x 3")
        feed = house.file().active_feed
        assert (feed.freq_min_hz, feed.beam_deg, feed.beam_az_deg, feed.beam_el_deg) == (12.2e9, None, 2.1, 3.0)
        assert house.state.beam.words == "2.1° x 3.0° entered by hand"

    @pytest.mark.parametrize(("typed", "said"), [
        ({"beam_deg": "2 x"}, "type one width, or two: 2.0 x 2.9"),
        ({"beam_deg": "1 x 2 x 3"}, "type one width, or two: 2.0 x 2.9"),
        ({"band": "1690"}, "is not a band. Type 1670 to 1710 MHz"),
        ({"band": "1710 to 1670 MHz"}, "does not go from a lower to a higher frequency"),
    ])  # fmt: skip
    def test_what_cannot_be_used_is_refused_and_nothing_is_written(self, house, typed, said):
        with pytest.raises(NoSuchChoice, match=said):
            house.setup.choose("feed", "other", {"name": "odd", **typed})
        assert "odd" not in house.file().feeds

    def test_one_of_the_file(self, house):
        edit(house.paths.config_file, {"feed.patch.beam_deg": 30.0})
        house.start().up()
        house.choose("feed", "feed-1")
        assert house.state.feed_name == "patch"


class TestLimits:
    def test_the_narrower_counts_and_the_dish_obeys(self, house):
        house.choose("limits", "own", floor="25", ceiling="90", cable_max="0")
        assert (house.state.el_min_deg, house.state.el_max_deg) == (25.0, 65.0)
        assert house.view("limits").evidence == (
            "el 25.00 to 65.00 (read from the dish, narrowed by yours); cable -423 to +0"
        )

    def test_emptied_they_are_the_dishs_own_again(self, house):
        house.choose("limits", "own", floor="25")
        house.choose("limits", "own")
        assert house.file().motion.min_elevation_deg is None
        assert house.state.el_min_deg == 18.0


class TestDirection:
    def test_moves_each_axis_asks_and_goes_back(self, house):
        house.setup.clear()
        house.choose("direction", "start")
        assert house.looks_at() == (pytest.approx(5.0, abs=0.1), pytest.approx(45.0, abs=0.1))
        assert "did it turn clockwise?" in house.view("direction").words[0]
        house.choose("direction", "yes")
        assert house.looks_at()[1] == pytest.approx(50.0, abs=0.1)
        assert "look higher than before?" in house.view("direction").words[0]
        house.choose("direction", "yes")
        az_deg, el_deg = house.looks_at()
        assert (az_deg + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=0.1)
        assert el_deg == pytest.approx(45.0, abs=0.1)
        assert house.marks()["direction"] == "done"

    @pytest.mark.parametrize(("answers", "words"), [(["no"], "azimuth went"), (["yes", "no"], "elevation went")])
    def test_a_no_fails_says_what_to_do_and_keeps_nothing(self, house, answers, words):
        house.setup.clear()
        for answer in ("start", "yes", "yes", "start", *answers):
            house.choose("direction", answer)
        assert house.marks()["direction"] == "failed"
        assert words in house.view("direction").evidence
        assert house.file().setup.direction is None
        assert house.looks_at()[1] == pytest.approx(45.0, abs=0.1)

    def test_at_the_ceiling_it_tries_the_other_way(self, build):
        house = build("g2?el=65").up()
        house.setup.clear()
        house.choose("direction", "start")
        house.choose("direction", "yes")
        assert "look lower than before?" in house.view("direction").words[0]
        assert house.looks_at()[1] == pytest.approx(60.0, abs=0.1)

    def test_who_did_not_look_sees_it_once_more(self, house):
        house.setup.clear()
        house.choose("direction", "start")
        before = len(house.moves())
        house.choose("direction", "again")
        assert house.looks_at()[0] == pytest.approx(5.0, abs=0.1)
        assert len(house.moves()) > before
        house.choose("direction", "yes")
        house.choose("direction", "again")
        assert house.looks_at()[1] == pytest.approx(50.0, abs=0.1)
        house.choose("direction", "yes")
        assert house.marks()["direction"] == "done"
        assert house.looks_at()[1] == pytest.approx(45.0, abs=0.1)

    def test_an_unhomed_dish_is_not_asked_to(self, build):
        house = build("g2?unhomed=1").up()
        house.setup.clear()
        with pytest.raises(NoSuchChoice):
            house.setup.choose("direction", "start")
        assert any("Home it first" in words for words in house.view("direction").words)


class TestFirst:
    def test_points_where_the_easiest_slot_stands_once_north_is_set(self, house):
        assert "point" not in {choice.name for choice in house.view("first").choices}
        house.setup.clear()
        house.choose("place", "typed", **PLACE)
        house.choose("north", "typed", az_offset_deg="0")
        assert house.view("first").evidence == "EchoStar 16 (61.5°W) expected at 132.8 / 32.7"
        house.choose("first", "point")
        assert house.looks_at() == (pytest.approx(132.8, abs=0.1), pytest.approx(32.7, abs=0.1))
        assert house.marks()["first"] == "todo"

    def test_what_is_no_satellite_is_refused_and_nothing_moves(self, house):
        house.setup.clear()
        house.choose("place", "typed", **PLACE)
        house.choose("north", "typed", az_offset_deg="0")
        before = len(house.moves())
        for typed in ("19.2E", "moon", "119"):
            with pytest.raises(NoSuchChoice, match="is no satellite of the list that is up here"):
                house.setup.choose("first", "search", {"slot": typed})
        assert len(house.moves()) == before

    def test_what_is_found_may_leave_north_as_it_is(self, house):
        house.setup.clear()
        house.choose("place", "typed", **PLACE)
        house.choose("north", "typed", az_offset_deg="0.7")
        house.choose("first", "search", 600.0, slot="61.5W")
        assert house.marks()["first"] == "todo"
        house.choose("first", "keep")
        assert house.marks()["first"] == "done"
        assert house.view("first").evidence.endswith("north left as it was")
        assert house.file().alignment.az_offset_deg == 0.7

    def test_stop_ends_the_search_and_says_so(self, house):
        house.setup.clear()
        house.choose("place", "typed", **PLACE)
        house.choose("north", "typed", az_offset_deg="0")
        house.setup.choose("first", "search", {"slot": "61.5W"})
        house.run(6)
        house.station.stop("you")
        house.until(lambda: not house.setup.busy)
        view = house.view("first")
        assert view.mark.value == "failed"
        assert "No satellite was found." in view.evidence
        before = len(house.moves())
        house.run(10)
        assert len(house.moves()) == before


def test_a_fault_of_the_station_is_a_failed_step(house):
    house.setup.clear()
    house.device.stall(0)
    house.setup.choose("north", "jog", {"d_az_deg": "30"})
    with pytest.raises(BirdcageError):
        house.setup.choose("north", "jog", {"d_az_deg": "30"})
    house.until(lambda: not house.setup.busy)
    assert house.marks()["north"] == "failed"
    assert house.view("north").choices[0].name == "release"


def test_a_stop_behind_the_release_of_a_step_holds(house):
    house.station.stop("you")
    house.run(2)
    house.setup.choose("north", "release", {})
    house.station.stop("you")  # before the station has served any of it
    house.until(lambda: not house.setup.busy)
    house.run(2)
    assert house.state.held is not None
    assert "STOP came after this release" in house.view("north").evidence
