"""An RTL-SDR tuned on F3: the dialog shows how it is, refuses what it does not take, and begins the picture anew."""

from __future__ import annotations

import pytest
import stage
import stand_in
from birdcage.base.errors import ConfigError
from birdcage.signal.monitor import SignalMonitor
from birdcage.signal.rtl_tcp_meter import Tuned
from test_signal_strip import hear
from test_signal_waterfall import SDR, spectrum

NOW = Tuned(1_420.4e6, 1.024e6, 200e3, 28.0)


class OneSdr:
    """The sources of a session that has an RTL-SDR."""

    facts, trouble, ids = SDR, "", ("rtl_tcp",)

    def __init__(self, tuned=NOW, refuses=""):
        self._tuned, self._refuses, self.asked = tuned, refuses, []

    def monitor(self, hears):
        return SignalMonitor([self], "rtl_tcp", hears)

    def get(self, _source):
        return self

    def subscribe(self, _hear):
        return lambda: None

    def watch(self, _watcher, *, steady=False):
        self.steady = steady

    def unwatch(self, _watcher):
        pass

    def tuned(self, _source):
        return self._tuned

    def tune(self, source, tuned):
        if self._refuses:
            raise ConfigError(self._refuses)
        self.asked.append((source, tuned))
        return True


def played(sources, *keys, size=(120, 36)):
    async def look(app, pilot):
        hear(app, [-40.0] * 4, SDR)
        app.signals.book.spectra.append(spectrum())
        for key in keys:
            await pilot.press(key)
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), len(app.signals.book.spectra), len(app.screen_stack)

    return stage.run(look, "idle", size, key="f3", signal=sources)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_it_shows_how_it_is_tuned(size):
    text, _spectra, layers = played(OneSdr(), "F", size=size)
    assert layers == 2
    for words in ("Tune rtl_tcp", "1420.4", "1024", "200", "28", "Enter tunes", "behind your LNB"):
        assert words in text, words


def test_what_is_typed_is_tuned_and_the_picture_begins_anew():
    sources = OneSdr()
    typed = ("F", "home", "ctrl+k", *"1694.1", "tab", *"2400", "tab", *"100", "tab", *"auto", "enter")
    text, spectra, layers = played(sources, *typed)
    assert sources.asked == [("rtl_tcp", Tuned(1_694.1e6, 2.4e6, 100e3, None))]
    assert (spectra, layers) == (0, 1)
    assert "Tuned to 1694.1 MHz. [signal.rtl_tcp] keeps it." in text


def test_what_it_does_not_take_stays_in_the_dialog():
    sources = OneSdr()
    text, spectra, layers = played(sources, "F", "tab", *"600", "enter")
    assert "Sample rate 600 kHz is out of range. Type 226 to 300, or 901 to 2400." in text
    assert (sources.asked, spectra, layers) == ([], 1, 2)


def test_settings_that_can_not_be_written_are_said_and_other_sources_are_not_tuned():
    text, spectra, _layers = played(OneSdr(refuses="birdcage.toml can't be written."), "F", "enter")
    assert "birdcage.toml can't be written." in text
    assert spectra == 1
    text, _spectra, layers = played(OneSdr(tuned=None), "F")
    assert layers == 1
    assert "The rtl_tcp is not tuned from here. s chooses an RTL-SDR behind rtl_tcp." in text
