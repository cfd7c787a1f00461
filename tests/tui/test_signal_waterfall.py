"""The waterfall of F3: where a carrier stands, which channel is measured, and what to do where there is none."""

from __future__ import annotations

import re

import pytest
import stage
from birdcage.signal.source import Scale, SignalFacts, SignalReading, Spectrum
from birdcage_tui.shown.signal_book import MOST_SPECTRA, SignalBook
from birdcage_tui.signal.receiver import ReceiverPane
from birdcage_tui.signal.waterfall import WaterfallPane

SDR = SignalFacts(
    "rtl_tcp", "rtl_tcp", "dBFS", Scale.LOG, 10.0, 2.0, None, 0.1, 1, 10.0, None, of_dish=False, demo=False
)
LOW_HZ, HIGH_HZ, CHANNEL_HZ = 1_419_788_000.0, 1_420_812_000.0, (1_420_300_000.0, 1_420_500_000.0)


def spectrum(carrier=0.6, levels=256):
    middle = int(carrier * levels)
    return Spectrum(
        tuple(-20.0 if index == middle else -75.0 + index % 3 for index in range(levels)), LOW_HZ, HIGH_HZ, CHANNEL_HZ
    )


def shown(size, count=30):
    async def look(app, pilot):
        app.signals.book.choose(SDR)
        app.signals.book.spectra.extend(spectrum() for _ in range(count))
        app.paint()
        for _ in range(2):
            await pilot.press("v")
            await pilot.pause()
            await pilot.pause()
        page = app.query_one("#page-signal")
        pane = page.query_one(WaterfallPane)
        return stage.stand_in.text_of(app), pane.region, page.query_one(ReceiverPane).region, app.screen.region

    return stage.run(look, "idle", size, key="f3")


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_a_carrier_is_a_line_down_with_its_frequencies_beneath(size):
    text, region, receiver, screen = shown(size)
    assert screen.contains_region(region)
    assert region.area > 0
    assert not region.overlaps(receiver)
    lines = text.splitlines()[region.y + 1 : region.bottom - 1]
    assert "1419.788 MHz" in lines[-1]
    assert "1420.812 MHz" in lines[-1]
    assert re.search(r"▲ *1420\.400 *▲", lines[-1])
    assert "newest on top   · from -66  █ from -29 dBFS" in text.splitlines()[region.bottom - 1]
    columns = [line.find("█") for line in lines[:-1]]
    assert len(set(columns)) == 1
    assert columns[0] == pytest.approx(0.6 * region.width, abs=3)


def test_without_a_spectrum_the_view_is_passed_over():
    text, region, _receiver, _screen = shown((80, 24), count=0)
    assert region.area == 0
    assert "Waterfall" not in text


def test_only_the_source_that_is_heard_fills_it_and_another_one_begins_anew():
    book, state = SignalBook(), stage.stand_in.STATES["idle"](stage.stand_in.VirtualClock())
    book.choose(SDR)
    for index in range(MOST_SPECTRA + 5):
        told = SignalReading(-40.0, "dBFS", float(index), state.position.utc, "rtl_tcp", 0.1, spectrum())
        book.hear(told, SDR, state)
    assert len(book.spectra) == MOST_SPECTRA
    book.choose(SignalFacts(**{name: getattr(SDR, name) for name in SDR.__slots__} | {"id": "other"}))
    assert not book.spectra
    book.hear(told, SDR, state)
    assert not book.spectra
