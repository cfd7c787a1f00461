"""The pinouts are those of reference section 1.1, and fit on the screen."""

from __future__ import annotations

import pytest
from birdcage.setup.wiring import CAUTIONS, CONNECTORS, SYMPTOMS, connector
from birdcage.setup.wiring_text import drawing_lines, wiring_lines
from birdcage.station.finding import Saw


def test_the_g2_as_drawn_top_to_bottom():
    assert [(pin.wire, pin.signal, pin.terminal) for pin in connector("g2").pins] == [
        ("white", "GND", "GND"),
        ("black", "TX-", "TB"),
        ("red", "TX+", "TA"),
        ("green", "RX-", "RB"),
        ("yellow", "RX+", "RA"),
        ("blue", "not used", ""),
    ]


def test_the_travler_and_the_old_carryout_left_to_right():
    signals = [pin.signal for pin in connector("travler").pins]
    assert signals == ["GND", "T/R-", "T/R+", "RXD-", "RXD+", "not used"]
    assert "Carryout of 2003" in connector("travler").dishes


def test_minus_comes_first_on_both():
    """The sources that draw the plug agree, whatever an earlier project's table says."""
    for key in ("g2", "travler"):
        assert [pin.number for pin in connector(key).pins] == [1, 2, 3, 4, 5, 6]
        assert [pin.signal[-1] for pin in connector(key).pins[1:5]] == ["-", "+", "-", "+"]
        assert any("Sources disagree" in note for note in connector(key).notes)
        assert connector(key).supported_by


def test_the_pro_has_usb_and_no_pairs():
    assert connector("pro").pins == ()
    assert "1200" in " ".join(connector("pro").notes)
    assert "swapped" not in "\n".join(wiring_lines([connector("pro")]))


def test_an_unknown_plug_names_those_there_are():
    with pytest.raises(KeyError, match="g2, travler, pro"):
        connector("tailgater")


def test_every_observation_that_wires_explain_has_a_row_and_a_source():
    assert {each.saw for each in SYMPTOMS} == {Saw.SILENCE, Saw.GARBAGE, Saw.ECHO}
    assert all(each.supported_by for each in SYMPTOMS)
    assert any("5 V" in text for text in CAUTIONS)


@pytest.mark.parametrize("width", [40, 60, 80, 120])
@pytest.mark.parametrize("plugs", [CONNECTORS, *((each,) for each in CONNECTORS)])
def test_it_fits_in_plain_ascii_and_loses_no_word(plugs, width):
    lines = wiring_lines(plugs, width)
    assert max(map(len, lines)) <= width
    text = "\n".join(lines)
    assert text.isascii()
    words = text.split()
    for each in plugs:
        for note in (*each.notes, each.supported_by):
            assert note.split()[-1] in words
        for pin in each.pins:
            assert any(pin.signal in line and pin.terminal in line and pin.wire in line for line in lines)


def test_the_drawing_shows_each_contact_once():
    for each in CONNECTORS[:2]:
        drawing = "\n".join(drawing_lines(each))
        for pin in each.pins:
            assert f"{pin.signal}" in drawing
            assert str(pin.number) in drawing
        assert max(map(len, drawing.splitlines())) <= 38
