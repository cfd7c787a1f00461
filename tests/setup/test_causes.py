"""From what was seen to what may be wrong: the right cause first, and the observation named."""

from __future__ import annotations

import pytest
from birdcage.detection.probe import USUAL_BAUDS, BaudFinding, Saw
from birdcage.setup.causes import Case, describe, find_causes
from birdcage.station.known import PortInfo, SystemFacts
from birdcage.station.state import LinkPhase, LinkState

SILENT = LinkState(LinkPhase.SILENT, detail="The dish is silent.")
LOST = LinkState(LinkPhase.LOST, detail="/dev/ttyUSB0 does not exist.")
CLEAN = SystemFacts("/dev/ttyUSB0", group="dialout", may_open=True, enrolled=True, modem_manager=False, brltty=False)
ADAPTER = PortInfo("/dev/ttyUSB0", None, "FTDI", "0403:6001", "A1", "1-1")


def found(baud, saw, sample="", count=None):
    return BaudFinding(baud, saw, sample, len(sample) if count is None else count, 0.7)


def all_rates(saw, sample="", count=None):
    return tuple(found(baud, saw, sample, count) for baud in USUAL_BAUDS)


def causes(*findings, link=SILENT, **more):
    return find_causes(Case("/dev/ttyUSB0", link, tuple(findings), **{"firmware_baud": 115200, **more}))


def likely(result):
    return [each.title for each in result if each.likely]


def by_title(result, start):
    return next(each for each in result if each.title.startswith(start))


def test_what_was_seen_in_one_line():
    findings = [
        found(115200, Saw.SILENCE),
        found(57600, Saw.GARBAGE, ".x..", 34),
        found(9600, Saw.ECHO, "", 1),
        found(19200, Saw.TEXT, "Bootloader"),
        found(38400, Saw.PROMPT, "TRK>"),
        found(2400, Saw.GARBAGE, ".", 1),
    ]
    assert describe(findings) == (
        "115200: silence; 57600: 34 bytes, garbage; 9600: own echo; 19200: text `Bootloader`; "
        "38400: prompt `TRK>`; 2400: 1 byte, garbage"
    )


def test_a_prompt_at_another_rate_is_one_key_away():
    result = causes(found(9600, Saw.SILENCE), found(115200, Saw.PROMPT, "TRK>"))
    assert len(result) == 1
    assert (result[0].use_baud, result[0].likely) == (115200, True)
    assert "TRK>" in result[0].why
    assert "9600" in result[0].why


def test_a_prompt_at_the_present_rate_needs_no_other():
    (only,) = causes(found(115200, Saw.PROMPT, "TRK>"))
    assert only.use_baud is None
    assert "firmware" in only.what_to_do


def test_text_at_another_rate_is_one_key_away():
    result = causes(found(9600, Saw.GARBAGE, "..", 2), found(57600, Saw.TEXT, "Motor init"))
    assert (result[0].use_baud, result[0].likely) == (57600, True)
    assert "Motor init" in result[0].why


def test_text_at_the_present_rate_is_a_dish_that_starts():
    result = causes(found(115200, Saw.TEXT, "Motor init"))
    assert likely(result) == ["The dish is starting"]
    assert all(each.use_baud is None for each in result)


def test_silence_everywhere_begins_at_the_dish():
    result = causes(*all_rates(Saw.SILENCE))
    assert likely(result) == [
        "The dish has no power", "The cable is out", "The dish is starting", "The sending pair is swapped",
    ]  # fmt: skip
    assert by_title(result, "The dish's shell is deadlocked").likely is False
    # The firmware's own rate was tried: the rate is not it.
    assert by_title(result, "Wrong baud").likely is False
    assert "5 baud rates" in result[0].why


def test_silence_after_the_boot_text_is_a_dish_that_starts():
    link = LinkState(
        LinkPhase.SILENT, last_reply=1000.0, detail="The dish talks, but nothing answered. It is starting."
    )
    result = find_causes(Case("/dev/ttyUSB0", link, firmware_baud=115200, restarted=True))
    assert likely(result) == ["The dish is starting"]
    assert result[0].title == "The dish is starting"


def test_before_any_other_rate_was_tried_it_tells_what_was_seen_and_not_what_that_may_mean():
    link = LinkState(
        LinkPhase.SILENT, detail="Enter brought nothing in 2.0 s. Check its power, or the baud rate is wrong."
    )
    for cause in find_causes(Case("/dev/ttyUSB0", link, firmware_baud=115200)):
        assert "Check its power" not in cause.why
    assert by_title(find_causes(Case("/dev/ttyUSB0", link)), "The cable").why.startswith(
        "Enter brought nothing in 2.0 s."
    )


def test_silence_of_a_dish_that_has_answered_is_not_a_swapped_wire():
    link = LinkState(LinkPhase.SILENT, last_reply=1000.0, detail="silent")
    result = causes(*all_rates(Saw.SILENCE), link=link)
    assert "The sending pair is swapped" not in likely(result)
    assert "The dish's shell is deadlocked" in likely(result)
    assert "answered before" in by_title(result, "The dish's shell").why


def test_silence_at_a_rate_that_is_not_the_firmwares():
    first = causes(found(9600, Saw.SILENCE))[0]
    assert (first.title, first.use_baud, first.likely) == ("Wrong baud rate", 115200, True)


def test_before_anybody_listened_the_link_speaks():
    result = causes(link=LinkState(LinkPhase.SILENT, detail="Enter brought nothing in 2.0 s."))
    assert "Enter brought nothing in 2.0 s." in result[0].why
    assert "The dish has no power" in likely(result)


def test_garbage_at_the_firmwares_own_rate_is_the_receiving_pair():
    result = causes(found(115200, Saw.GARBAGE, "....", 34))
    assert likely(result) == ["The receiving pair is swapped"]
    assert "115200" in result[0].why
    assert by_title(result, "The level").what_to_do.endswith("5 V.")


def test_garbage_at_another_rate_is_the_rate():
    result = causes(found(57600, Saw.GARBAGE, "....", 34))
    assert likely(result) == ["Wrong baud rate"]
    assert result[0].use_baud == 115200


def test_garbage_at_all_rates_is_not_mended_by_a_rate():
    result = causes(*all_rates(Saw.GARBAGE, "....", 4))
    assert likely(result) == ["The receiving pair is swapped"]
    assert all(each.use_baud is None for each in result)


def test_garbage_of_an_unknown_firmware_promises_no_rate():
    result = causes(found(57600, Saw.GARBAGE, "....", 34), firmware_baud=None)
    assert likely(result) == ["Wrong baud rate"]
    assert result[0].use_baud is None


def test_echo_at_each_rate_is_the_adapter():
    result = causes(*all_rates(Saw.ECHO, "", 1))
    assert likely(result) == ["The adapter hears itself"]
    assert "4-wire" in result[0].what_to_do


def test_echo_at_one_rate_alone_is_a_deadlocked_shell():
    result = causes(found(115200, Saw.ECHO, "", 2), found(57600, Saw.SILENCE), found(9600, Saw.SILENCE))
    assert likely(result) == ["The dish's shell is deadlocked"]
    assert "power off" in result[0].what_to_do


def test_a_missing_adapter():
    result = causes(link=LOST, system=SystemFacts("/dev/ttyUSB0", modem_manager=False, brltty=False))
    assert likely(result) == ["The adapter is out"]
    assert "No serial port is plugged in" in result[0].what_to_do


def test_a_missing_adapter_among_others_names_them():
    other = PortInfo("/dev/ttyUSB3")
    result = causes(link=LOST, ports=(other,))
    assert "/dev/ttyUSB3" in result[0].what_to_do


def test_brltty_is_likely_where_the_adapter_vanished():
    facts = SystemFacts("/dev/ttyUSB0", brltty=True)
    assert likely(causes(link=LOST, system=facts))[0] == "brltty takes the adapter"
    assert "brltty takes the adapter" not in likely(causes(*all_rates(Saw.SILENCE), system=facts))


@pytest.mark.parametrize(
    ("facts", "title", "command"),
    [
        ({"group": "dialout", "may_open": False, "enrolled": False}, "Not permitted", "usermod -aG dialout"),
        ({"group": "uucp", "may_open": False, "enrolled": True}, "Not permitted yet", "newgrp uucp"),
        ({"may_open": True, "other_program": "screen (process 7)"}, "Another program uses it", ""),
    ],
)
def test_a_port_that_does_not_open(facts, title, command):
    result = causes(link=LOST, ports=(ADAPTER,), system=SystemFacts("/dev/ttyUSB0", **facts))
    assert likely(result) == [title]
    assert command in result[0].command
    assert result[0].what_to_do


def test_a_port_that_does_not_open_for_no_known_reason():
    result = causes(link=LOST, ports=(ADAPTER,), system=CLEAN)
    assert likely(result) == ["The port does not open"]
    assert LOST.detail in result[0].why


def test_a_program_that_is_seen_comes_before_what_is_only_thought_of():
    facts = SystemFacts("/dev/ttyUSB0", may_open=True, other_program="screen (process 7)", modem_manager=True)
    silent = causes(*all_rates(Saw.SILENCE), system=facts)
    assert (silent[0].title, silent[-1].title) == ("Another program uses it", "ModemManager meddles")
    answered = causes(found(9600, Saw.SILENCE), found(115200, Saw.PROMPT, "TRK>"), system=facts)
    assert answered[0].use_baud == 115200


def test_modem_manager_is_named_while_it_runs_and_likely_when_it_was_heard():
    facts = SystemFacts("/dev/ttyUSB0", may_open=True, modem_manager=True)
    quiet = causes(*all_rates(Saw.SILENCE), system=facts)
    assert by_title(quiet, "ModemManager").likely is False
    assert by_title(quiet, "ModemManager").command == "sudo systemctl stop ModemManager"
    heard = causes(found(115200, Saw.TEXT, "AT ATE1 AT+GMI"), system=facts)
    assert by_title(heard, "ModemManager").likely is True


def test_a_server_on_the_network_is_not_plugged_in():
    (only,) = find_causes(Case("socket://host:2000", LinkState(LinkPhase.LOST, detail="no answer")))
    assert "server" in only.what_to_do
    case = Case("socket://host:2000", SILENT, (found(57600, Saw.SILENCE),), firmware_baud=115200)
    rate = by_title(find_causes(case), "Wrong baud")
    assert (rate.use_baud, rate.what_to_do) == (None, "Set 115200 baud at the serial server.")


def test_nothing_is_wrong_while_the_dish_answers():
    assert causes(link=LinkState(LinkPhase.UP)) == ()


@pytest.mark.parametrize("saw", list(Saw))
def test_the_likely_ones_come_first_and_each_says_why_and_what(saw):
    for findings in ((found(9600, saw, "abc"),), all_rates(saw, "abc")):
        result = causes(*findings, system=CLEAN)
        marks = [each.likely for each in result]
        assert marks == sorted(marks, reverse=True)
        assert any(marks)
        assert all(each.why and each.what_to_do for each in result)
        named = ("baud rates", *(str(each.baud) for each in findings))
        assert all(any(name in cause.why for name in named) for cause in result)
