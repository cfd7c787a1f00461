"""The tone of a page: by the sound system where there is one, else by the terminal's bell."""

from __future__ import annotations

from textual.timer import Timer

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.tone_words import bell_period_s, pitch_hz
from birdcage_tui.widgets.page import Page

WAITS_S = 0.3
"""How soon it is looked again while there is nothing to ring for."""
RENEWS_S = 0.05
"""How often the pitch is set anew."""
BELL = "Bell on: faster is hotter. t: silence."


class PageTone:
    """Sounds while its page is seen, from `switch` to `switch`."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self.is_on = False
        self._next: Timer | None = None
        """Brings the next bell, or the next look at the pitch."""
        self._told = False

    @property
    def _host(self) -> AppHost:
        return self._page.host

    @property
    def words(self) -> str:
        """What it does now, in short; empty while it is off."""
        if not self.is_on:
            return ""
        return "tone on: higher is hotter" if self._plays else "bell on: faster is hotter"

    @property
    def _plays(self) -> bool:
        sound = self._host.signals.sound
        return sound is not None and not sound.trouble

    def switch(self) -> None:
        """Turn it on or off, and say which."""
        self.is_on, self._told = not self.is_on, False
        if not self.is_on:
            self._end()
            self._host.say("Tone off.")
            return
        self._turn()
        if self._plays:
            self._host.say("The pitch rises with the signal. Silence: nothing new is heard. t: silence.")
        else:
            self._say_bell()

    def resume(self) -> None:
        """Take it up again where the page was left with it."""
        if self.is_on and self._next is None:
            self._turn()

    def _turn(self) -> None:
        """Sound, if there is something to sound for, and see to the next turn; on a page that is left it ends."""
        self._next = None
        page, sound = self._page, self._host.signals.sound
        if not (self.is_on and page.display and page.is_attached):
            self._end()
            return
        view = self._host.view()
        if sound is not None and not sound.trouble:
            sound.play(pitch_hz(view))
            self._next = page.set_timer(RENEWS_S, self._turn)
            return
        period_s = bell_period_s(view)
        if period_s is not None:
            page.app.bell()
        self._next = page.set_timer(WAITS_S if period_s is None else period_s, self._turn)
        if sound is not None and not self._told:
            self._say_bell()  # last: it paints

    def _say_bell(self) -> None:
        sound, self._told = self._host.signals.sound, True
        why = self._host.signals.no_sound if sound is None else sound.trouble
        self._host.say(f"{why} {'there is no sound. ' if sound is None and why else ''}{BELL}".strip())

    def _end(self) -> None:
        if self._next is not None:
            self._next.stop()
            self._next = None
        if self._host.signals.sound is not None:
            self._host.signals.sound.close()
