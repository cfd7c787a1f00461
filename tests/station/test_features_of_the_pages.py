"""What the hardware, motors and receiver of a G2 tell and let be set, through the station, from the simulated dish."""

from __future__ import annotations

from contextlib import suppress

import pytest
from birdcage.base.errors import CommandRefused, ConfirmationNeeded, Held, NoReply, OutOfRange
from birdcage.protocol.g2.diseqc import answer_in_words
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.feature import FeaturePage
from birdcage.station.requests import AcknowledgeFault, Goto, Read, Release, Set, Stop
from birdcage.station.state import Activity

from .conftest import Bench

YOU = "you"


def bench_of(tmp_path, address="g2?seed=1"):
    bench = Bench(address=address, options={"backup_folder": tmp_path})
    bench.watch("position")
    bench.connect(10.0)
    assert bench.state.activity is Activity.IDLE
    return bench


@pytest.fixture
def bench(tmp_path):
    return bench_of(tmp_path)


def read(bench, *ids, agreed=False):
    return {name: reading.value for name, reading in bench.do(Read(ids, agreed=agreed), 120.0).items()}


def sent(bench, since):
    return bench.lines()[since:]


def test_every_feature_stands_on_a_page_under_a_heading_and_each_heading_stands_once():
    places = [(each.page, each.group) for each in CARRYOUT_G2.features.values()]
    assert all(page is not None and group for page, group in places)
    headings = [place for at, place in enumerate(places) if at == 0 or places[at - 1] != place]
    assert len(headings) == len(set(headings))
    pages = [page for at, (page, _group) in enumerate(headings) if at == 0 or headings[at - 1][0] is not page]
    assert pages == list(FeaturePage)


# hardware


def test_pins_are_told_by_port_with_what_they_are_for_by_one_line(bench):
    since = len(bench.lines())
    told = read(bench, *(f"pins.{port}" for port in "abcde"))
    assert sent(bench, since).count("regs") == 1
    port_e = told["pins.e"].splitlines()
    assert port_e[0] == "E0  1  SPI1_PCS1 A3981 #2 chip select (EL motor)"
    assert "E3  0  SPI1_SIN  MISO, A3981 to processor" in port_e
    assert "E5  1  SPI1_PCS2 likely A3981 reset or enable" in port_e
    assert "E24 1  UART4_TX  console TX, to the computer" in port_e
    assert port_e[-2:] == ["low: E6 to E7, E12", "unknown: E29"]
    assert "D11 1  SPI2_PCS0 BCM4515 chip select (tuner)" in told["pins.d"]
    assert "C18 1            likely LNB voltage control or relay" in told["pins.c"]
    assert told["pins.a"] == "low: A0 to A19, A24 to A29"
    assert told["pins.b"].splitlines()[-1] == "low: B4 to B10, B16 to B19"


def test_a_pin_shows_how_it_stands_now(tmp_path):
    bench = bench_of(tmp_path, "g2?seed=1&pins_follow=1")
    assert "C18 1  " in read(bench, "pins.c")["pins.c"]
    bench.do(Set("enable_lna", True, YOU, agreed=True))
    bench.step(6.0)
    assert "C18 0  " in read(bench, "pins.c")["pins.c"]


@pytest.mark.parametrize(("options", "words"), [
    ("", "all switches up (off); code 101: DISH at 110, 119 and 129° west"),
    ("&dip_raw=ffffff05&dip_code=7",
     "pins 0xffffff05, and no source tells which is which; code 7: no source tells its satellites"),
])  # fmt: skip
def test_dip_switches_are_told_in_words(tmp_path, options, words):
    assert read(bench_of(tmp_path, f"g2?seed=1{options}"), "dip_meaning")["dip_meaning"] == words
    assert "search is disabled" in CARRYOUT_G2.features["dip_meaning"].note


def test_the_first_entries_of_the_processors_memory_are_read_and_none_is_written(tmp_path):
    bench = bench_of(tmp_path, "g2?seed=1&eeprom_written=3")
    since = len(bench.lines())
    told = read(bench, "eeprom")["eeprom"].splitlines()
    assert told[:4] == [" 0  0", " 1  0", " 2  0", " 3  --"]
    assert told[-1] == "15  --"
    assert [line for line in sent(bench, since) if line.startswith("ee ")] == [f"ee {index}" for index in range(16)]
    assert CARRYOUT_G2.features["eeprom"].cost.lines == 16


def test_driver_faults_are_cleared_after_consent(bench):
    bench.device.stall(0)
    bench.station.submit(Goto(90.0, 40.0, YOU))
    bench.step(8.0)
    before = read(bench, "driver.azimuth", "driver.elevation")
    with pytest.raises(ConfirmationNeeded, match="Look for the cause first"):
        bench.do(Set("clear_driver_faults", True, YOU))
    with pytest.raises(Held):
        bench.do(Set("clear_driver_faults", True, YOU, agreed=True))
    assert "reset" not in bench.lines()
    bench.do(AcknowledgeFault(YOU))
    bench.do(Release(YOU))
    bench.do(Set("clear_driver_faults", True, YOU, agreed=True))
    assert "reset" in bench.lines()
    assert before == {"driver.azimuth": "FAULT", "driver.elevation": "OK"}
    assert read(bench, "driver.azimuth") == {"driver.azimuth": "OK"}


# motors


def test_an_acceleration_is_set_until_restart_and_moves_take_longer(bench):
    before = read(bench, "acceleration.azimuth", "acceleration.elevation")
    assert before == {
        "acceleration.azimuth": pytest.approx(396.0),
        "acceleration.elevation": pytest.approx(403.85, abs=0.01),
    }
    nominal = CARRYOUT_G2.azimuth.acceleration_deg_s2
    assert before["acceleration.azimuth"] == pytest.approx(nominal, rel=0.02), "the nominal one is a fact of the axis"
    since = len(bench.lines())
    reading = bench.do(Set("acceleration.azimuth", 90.0, YOU, agreed=True))
    assert reading.value == pytest.approx(90.0)
    assert [line for line in sent(bench, since) if line.startswith("ma")] == ["ma 0 10", "ma"]
    bench.step(6.0)
    after = read(bench, "acceleration.azimuth", "acceleration.elevation")
    assert after == {**before, "acceleration.azimuth": pytest.approx(90.0)}
    bench.do(Set("acceleration.azimuth", before["acceleration.azimuth"], YOU, agreed=True))
    bench.step(6.0)
    assert read(bench, "acceleration.azimuth")["acceleration.azimuth"] == pytest.approx(396.0)


def test_an_acceleration_that_the_dish_does_not_take_is_refused(bench, monkeypatch):
    commands = bench.device.shell._menus["step"].commands
    show = commands["ma"]
    monkeypatch.setitem(commands, "ma", lambda _args: show([]))
    with pytest.raises(CommandRefused, match=r"was told 90\.0°/s² for the azimuth and shows 396\.0°/s²"):
        bench.do(Set("acceleration.azimuth", 90.0, YOU, agreed=True))


def took_s(bench, azimuth):
    """Return how long the dish itself needs to an azimuth."""
    begun = bench.clock.monotonic()
    bench.station.submit(Goto(azimuth, 40.0, YOU))
    bench.step(0.3)
    while bench.device.truth().moving:
        bench.step(0.05)
    return bench.clock.monotonic() - begun


def test_the_simulated_dish_moves_by_its_acceleration_and_not_by_its_gains(bench):
    took_s(bench, 100.0)
    bench.step(20.0)
    nominal_s = took_s(bench, 150.0)
    bench.step(20.0)
    bench.do(Set("kp.azimuth", 100.0, YOU, agreed=True))
    assert took_s(bench, 100.0) == pytest.approx(nominal_s, abs=0.1)
    bench.step(20.0)
    bench.do(Set("acceleration.azimuth", 9.0, YOU, agreed=True))
    assert took_s(bench, 150.0) > 2.0 * nominal_s


def test_what_an_axis_shows_as_its_acceleration_can_always_be_put_back(bench):
    for axis in ("azimuth", "elevation"):
        name = f"acceleration.{axis}"
        CARRYOUT_G2.features[name].check(read(bench, name)[name])


def test_one_gain_is_set_and_the_others_stay(bench):
    before = read(bench, *(f"{gain}.{axis}" for gain in ("kp", "kv", "ki") for axis in ("azimuth", "elevation")))
    since = len(bench.lines())
    assert bench.do(Set("kv.elevation", 60.0, YOU, agreed=True)).value == 60.0
    kp, ki = before["kp.elevation"], before["ki.elevation"]
    assert [line for line in sent(bench, since) if line.startswith("pid")] == ["pid", f"pid 1 {kp:g} 60 {ki:g}", "pid"]
    assert read(bench, *before) == {**before, "kv.elevation": 60.0}


@pytest.mark.parametrize(
    ("value", "sent_as"), [(0.00002, "0.00002"), (123.456789, "123.456789"), (1000.0, "1000"), (0.0, "0")]
)
def test_a_gain_goes_out_in_digits_without_an_exponent(bench, value, sent_as):
    since = len(bench.lines())
    with suppress(CommandRefused, NoReply):  # what it shows then is the dish's
        bench.do(Set("kp.azimuth", value, YOU, agreed=True))
    (line,) = [line for line in sent(bench, since) if line.startswith("pid ")]
    assert line.split()[2] == sent_as


@pytest.mark.parametrize(("value", "words"), [(1000.5, "limit of 1000"), (-1.0, "limit of 0")])
def test_a_gain_has_a_limit_of_birdcages_own_and_says_so(bench, value, words):
    since = len(bench.lines())
    with pytest.raises(OutOfRange, match=words):
        bench.do(Set("kp.azimuth", value, YOU, agreed=True))
    assert not [line for line in sent(bench, since) if line.startswith("pid")]
    feature = CARRYOUT_G2.features["kp.azimuth"]
    assert "birdcage's own" in feature.note
    assert "oscillate" in feature.hazard
    with pytest.raises(ConfirmationNeeded, match="oscillate"):
        bench.do(Set("kp.azimuth", 200.0, YOU))


def test_a_gain_that_the_dish_does_not_take_is_refused(bench, monkeypatch):
    commands = bench.device.shell._menus["mot"].commands
    show = commands["pid"]
    monkeypatch.setitem(commands, "pid", lambda args: show(args[:1]))
    with pytest.raises(CommandRefused, match=r"was told Kp 200 for the azimuth and shows 250\. Set it again") as raised:
        bench.do(Set("kp.azimuth", 200.0, YOU, agreed=True))
    assert str(raised.value).endswith("Set it again, or restart the dish: it forgets gains then.")


def test_nothing_is_written_while_the_dish_moves(bench):
    bench.station.submit(Goto(90.0, 40.0, YOU))
    bench.step(0.5)
    for feature, value in (("kp.azimuth", 200.0), ("acceleration.azimuth", 90.0), ("clear_driver_faults", True)):
        with pytest.raises(Exception, match="moves"):
            bench.do(Set(feature, value, YOU, agreed=True))
    bench.do(Stop(YOU))


# receiver


def test_what_is_on_the_coax_is_asked_and_may_answer_nothing(tmp_path):
    ids = ("lnb_id", "lnb_status", "committed_switch", "lnb_config")
    assert read(bench_of(tmp_path), *ids) == {
        "lnb_id": "no answer", "lnb_status": "no answer", "committed_switch": "no answer",
        "lnb_config": "3 21180544 238 <4.5",
    }  # fmt: skip
    told = read(bench_of(tmp_path, "g2?seed=1&switch_port=2"), *ids)
    assert told["committed_switch"] == "Committed switch: 0xF4"
    assert told["lnb_id"] == "LNB Hardware ID: 0x41"


def test_the_table_of_transponders_is_read_after_consent_and_never_unasked(bench):
    with pytest.raises(ConfirmationNeeded, match="no STOP reaches it"):
        bench.do(Read(("transponders",)))
    bench.watch("position", "transponders", "transponders.extended")
    since = len(bench.lines())
    bench.step(120.0)
    assert not {"table", "tablex"} & set(sent(bench, since))
    told = read(bench, "transponders", "transponders.extended", agreed=True)
    assert len(told["transponders"].splitlines()) == 32
    assert "Lock:" in told["transponders"]
    assert "Sym:" in told["transponders.extended"]


def test_a_message_is_sent_as_typed_and_its_answer_told_in_words(tmp_path):
    bench = bench_of(tmp_path, "g2?seed=1&switch_port=1")
    with pytest.raises(ConfirmationNeeded, match="polarisation, band or input may change"):
        bench.do(Set("diseqc", "E0 10 38 F4", YOU))
    since = len(bench.lines())
    told = bench.do(Set("diseqc", "e01038f4", YOU, agreed=True)).value
    assert "send E0 10 38 F4" in sent(bench, since)
    assert told == "E0 10 38 F4 sent; the dish printed: Tx: E0 10 38 F4"
    assert read(bench, "committed_switch")["committed_switch"] == "Committed switch: 0xF4"
    told = bench.do(Set("diseqc", "E2 10 38 F0", YOU, agreed=True)).value
    assert told == "E2 10 38 F0 sent; E4: reply: OK"
    assert "diseqc" not in bench.state.readings, "what was sent is no value that holds"


@pytest.mark.parametrize(("message", "printed", "words"), [
    ("E01038F0", (), "E0 10 38 F0 sent; no reply wanted"),
    ("E2106400", (), "E2 10 64 00 sent; nothing was printed"),
    ("E23164", ("Tx: E2 31 64", "Rx: E4 C0"), "E2 31 64 sent; E4 C0: reply: OK; move completed, limits enabled"),
    ("E23164", ("Rx noise",), "E2 31 64 sent; the dish printed: Rx noise"),
    ("E23164", None, "E2 31 64 sent; no answer (RxReplyTimeout)"),
])  # fmt: skip
def test_what_came_back_is_told_in_words(message, printed, words):
    assert answer_in_words(bytes.fromhex(message), printed) == words


def test_a_message_that_nobody_answers_says_so(bench):
    told = bench.do(Set("diseqc", "E2 31 64", YOU, agreed=True)).value
    assert told == "E2 31 64 sent; no answer (RxReplyTimeout)"


@pytest.mark.parametrize("typed", ["", "E0 10 38 F0 00 00 00", "E0 XX", "on"])
def test_what_is_no_message_is_refused_with_nothing_sent(bench, typed):
    since = len(bench.lines())
    with pytest.raises(OutOfRange, match=r"Give 1 to 6.*Nothing was sent\."):
        bench.do(Set("diseqc", typed, YOU, agreed=True))
    assert not [line for line in sent(bench, since) if line.startswith("send")]
