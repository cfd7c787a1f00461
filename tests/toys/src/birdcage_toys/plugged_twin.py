"""What the twins share: a plug, and being mute."""

from __future__ import annotations

from birdcage.testing import Twin


class PluggedTwin(Twin):
    """`heard` is each motion that it has taken, `calls` how many lines or calls have reached it."""

    def __init__(self, clock):
        self.clock = clock
        self.plugged, self.muted, self.heard, self.calls = True, False, [], 0

    def taken(self):
        return self.heard

    def received(self):
        return self.calls

    def unplug(self):
        self.plugged = False

    def plug(self):
        self.plugged = True

    def mute(self):
        self.muted = True

    def unmute(self):
        self.muted = False
