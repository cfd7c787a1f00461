"""Takes the rules of motion, the alignment and the feed from settings, at the start and at run time."""

from __future__ import annotations

import os
from dataclasses import replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.az_el import MOST_MISSED_DEG
from birdcage.base.beam import beam_of
from birdcage.base.config import Settings
from birdcage.base.errors import BirdcageError, CommandRefused
from birdcage.base.reason import Reason
from birdcage.station.converter import converter_of
from birdcage.station.parts import Parts
from birdcage.station.settings import Rules, rules_from
from birdcage.station.state import MOVING
from birdcage.station.state_store import StateStore


def refuse_while_moving(store: StateStore, antenna: BirdcageAntenna, so: str) -> None:
    """Raise BirdcageError (`moving`) while the dish moves; `so` is what is not done meanwhile."""
    if antenna.motion is not None or store.state.activity in MOVING:
        raise BirdcageError(f"{so} while the dish moves. Wait until it rests, or stop it.", reason=Reason.MOVING)
    if store.state.raw_motion:
        raise BirdcageError(
            f"{so}: a raw line may have set the dish in motion. Give the console back, or STOP.",
            reason=Reason.MOVING,
        )


def refusal_of(wrong_facts: tuple[str, ...]) -> str | None:
    """Return why nothing moves where a fact of the owner's can't count; None where all can."""
    return f"Nothing moves: {wrong_facts[0]} Fix birdcage.toml and start again." if wrong_facts else None


class Applying:
    """The one place where rules come into force."""

    def __init__(self, parts: Parts, wrong_facts: tuple[str, ...]) -> None:
        self._store, self._antenna, self._mover, self._reader = parts.store, parts.antenna, parts.mover, parts.reader
        self._file = parts.settings.file
        self._wrong_facts = refusal_of(wrong_facts)

    def apply(self, settings: Settings) -> None:
        """Take over what these settings say. BirdcageError (`moving`) while the dish moves."""
        refuse_while_moving(self._store, self._antenna, "Settings are not taken over")
        self.use(rules_from(settings))

    def reload(self, file: str) -> None:
        """Read the settings again and apply them. CommandRefused where they come from another file than this one."""
        own = self._file
        if own is None:
            raise CommandRefused("The program that has the port reads no birdcage.toml. Start it again.")
        if os.path.realpath(own.path) != os.path.realpath(file):
            words = f"The program that has the port reads {own.path}, not {file}. Write there, or start it again."
            raise CommandRefused(f"{words} It goes on as before.", reason=Reason.BAD_PARAMETER)
        refuse_while_moving(self._store, self._antenna, "Settings are not taken over")
        self.apply(own.load())

    def use(self, rules: Rules) -> None:
        """Put the rules into force, and show everything that follows from them."""
        alignment, position = rules.alignment, self._store.state.position
        self._antenna.align(alignment)
        self._reader.rules = rules
        self._antenna.stop_consent = rules.stop_releases_motors
        self._mover.forget_target()  # it was true under the alignment of before
        if position is not None:
            az_deg, el_deg = alignment.to_true(position.dish_az_deg, position.dish_el_deg)
            position = replace(position, az_deg=az_deg, el_deg=el_deg)
        beam = beam_of(rules.feed, self._antenna.model.reflector)
        self._antenna.rotator.most_missed_deg = MOST_MISSED_DEG if beam is None else beam.narrow_deg / 2.0
        self._store.change(
            position=position, alignment=alignment,
            az_offset_deg=alignment.az_offset_deg, el_offset_deg=alignment.el_offset_deg,
            feed_name=rules.feed_name, converter=converter_of(rules.feed), beam=beam,
            unplanned_stop=self._antenna.strategy.unplanned, stow_allowed=rules.stow_allowed,
            motion_refused_because=rules.refuse_motion or self._wrong_facts,
        )  # fmt: skip
        self._reader.limit()
