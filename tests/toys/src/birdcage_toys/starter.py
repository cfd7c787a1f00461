"""A Pushy whose azimuth is counted from where it stood when it was switched on: a person has to tell where that points.

It says `BOOT` as it starts. Its elevation it measures itself.
"""

from __future__ import annotations

from dataclasses import replace

from birdcage_toys.pushy import FACTS, Pushy

BOOT = "BOOT"


class Starter(Pushy):
    facts = replace(FACTS, name="Starter", firmware="starter", zero_at_power_up=("pan",))

    def _hear(self, line):
        if line.text == BOOT:
            self._hooks.on_restart(line.text)
        else:
            super()._hear(line)


class LateStarter(Starter):
    """Known for what it is only once it was met."""

    facts = replace(Starter.facts, firmware="late_starter", zero_at_power_up=())

    def meet(self):
        super().meet()
        self.facts = replace(self.facts, zero_at_power_up=("pan",))
        self._hooks.on_facts(self.facts)
