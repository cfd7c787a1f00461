"""The pinouts are those of `docs/wiring.md`, *Pins*, and fit on the screen."""

from __future__ import annotations

import pytest
from birdcage.detection.probe import Saw
from birdcage.setup.wiring import CAUTIONS, connector, connectors, spoken_behind, symptoms
from birdcage.setup.wiring_text import adapter_lines, drawing_lines, wiring_lines


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
    for key in ("travler", "carryout"):
        signals = [(pin.signal, pin.terminal) for pin in connector(key).pins]
        assert signals == [("GND", "GND"), ("T/R-", "TB"), ("T/R+", "TA"), ("RXD-", "RB"), ("RXD+", "RA"),
                           ("not used", "")]  # fmt: skip


def test_the_old_carryout_tells_its_supply_its_grinding_and_what_not_to_switch_off():
    plug = connector("carryout")
    assert plug.dishes == "Carryout of 2003"
    assert (spoken_behind(connector("g2")), spoken_behind(connector("travler"))) == (("g2",), ("hal000", "hal205"))
    notes = " ".join(plug.notes)
    for words in ("12 V DC, at least 1 A", "no limit switches", "grind", "10 to 15 minutes",
                  "Leave its tracking enabled", "No known command stops it"):  # fmt: skip
        assert words in notes
    assert "under the radome" in plug.plug
    assert "Carryout" not in " ".join((connector("travler").dishes, *connector("travler").notes))


def test_minus_comes_first_on_all():
    """The sources that draw the plug agree, whatever an earlier project's table says."""
    for key in ("g2", "travler", "carryout"):
        assert [pin.number for pin in connector(key).pins] == [1, 2, 3, 4, 5, 6]
        assert [pin.signal[-1] for pin in connector(key).pins[1:5]] == ["-", "+", "-", "+"]
        assert connector(key).supported_by


def test_the_pro_has_usb_and_no_pairs():
    assert connector("pro").pins == ()
    assert "1200" in " ".join(connector("pro").notes)
    assert "swapped" not in "\n".join(wiring_lines([connector("pro")]))


def test_an_unknown_plug_names_those_there_are():
    with pytest.raises(KeyError, match="carryout, easycomm, g2, travler, pro"):
        connector("tailgater")


def test_every_observation_that_wires_explain_has_a_row_and_a_source():
    assert {each.saw for each in symptoms()} == {Saw.SILENCE, Saw.GARBAGE, Saw.ECHO}
    assert all(each.supported_by for each in symptoms())
    assert any("5 V" in text for text in CAUTIONS)


@pytest.mark.parametrize("width", [40, 60, 80, 120])
@pytest.mark.parametrize("plugs", [connectors(), *((each,) for each in connectors())])
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
    for each in connectors()[:3]:
        drawing = "\n".join(drawing_lines(each))
        for pin in each.pins:
            assert f"{pin.signal}" in drawing
            assert str(pin.number) in drawing
        assert max(map(len, drawing.splitlines())) <= 38


def test_the_two_kinds_of_line_adapters_and_bias_are_told_in_plain_ascii():
    lines = adapter_lines(80)
    text = " ".join(" ".join(lines).split())
    assert max(map(len, lines)) <= 80
    assert text.isascii()
    for words in ("four signal wires", "RS-485 with two wires", "hears its own echo", "SH-U11", "DTECH", "ESP32",
                  "560 ohm", "120 ohm"):  # fmt: skip
        assert words in text, words


@pytest.mark.parametrize("key", ["g2", "travler", "carryout"])
def test_the_supply_of_a_dish_stands_with_its_plug(key):
    assert any(note.startswith("Supply: ") and "label" in note for note in connector(key).notes)
