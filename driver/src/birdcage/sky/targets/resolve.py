"""The one reader of names: from what a person types, anywhere, to a target, or to why there is none."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import lru_cache

from birdcage.base.reason import Reason
from birdcage.sky.ahead import is_ahead
from birdcage.sky.downlinks import Downlink
from birdcage.sky.downlinks_read import shipped
from birdcage.sky.elements import ElementSet
from birdcage.sky.ephemeris.bodies import BODIES
from birdcage.sky.slots import Slot, slots
from birdcage.sky.targets.forms import read_form, slot_at
from birdcage.sky.targets.model import BodyTarget, Satellite, SlotTarget, Star
from birdcage.sky.targets.names import NamedSender, OffAir, names_of, plain, senders
from birdcage.sky.targets.problems import absent, ambiguous, only_silent, unknown, unnumbered
from birdcage.sky.targets.resolution import Hit, Resolution, Searchable, TargetCandidate
from birdcage.sky.targets.stars import NamedStar, stars

LOOKED_AT = 200
"""How many hits of a search are looked through."""
LEAST_PART = 2
"""So many letters of a name at least count as a part of it."""


class Resolver:
    """Reads names with one catalogue and one table of downlinks; both may be exchanged by making another."""

    def __init__(self, shelf: Searchable | None = None, downlinks: Iterable[Downlink] | None = None) -> None:
        self._shelf = shelf
        self._senders = _shipped_senders() if downlinks is None else senders(downlinks)
        self._search = lru_cache(maxsize=32)(self._search_shelf)  # a text is looked up several times on its way

    def resolve(self, text: str) -> Resolution:
        """Return what a text means.

        The order in which one meaning is preferred to another:

        1. numbers: `28.2E`, `dish 119`, `ra=5h34m,dec=+22d`, `gal 120,-5`, `180 45`
        2. Sun, Moon, planets; stars and radio sources by a whole name
        3. a satellite of the catalogue by number, or by its whole name
        4. a place on the arc by a whole name, then a satellite by another of its names (`downlinks.toml`), and by the
           part of its name before or in brackets if it is the only one
        5. whatever alone has the text in its name

        A name of the table of downlinks of which the catalogue has no elements is `absent`: no other satellite is
        taken for it because its name is similar.
        """
        typed = " ".join(text.split())
        if not typed:
            return unknown(typed, ())
        if not typed.isdecimal():
            try:
                form = read_form(typed)
            except ValueError as error:
                return Resolution(typed, reason=Reason.ANGLE, problem=str(error))
            if form is not None:
                return Resolution(typed, TargetCandidate(form, typed), exact=True)
        exact = self._exactly(typed)
        if exact is not None and exact.found is not None:
            return exact
        found = self.find(typed)
        if exact is not None:
            return replace(exact, candidates=exact.candidates or found)
        if typed.isdecimal():
            return unnumbered(typed, found, self._shelf)
        if len(found) == 1:
            return Resolution(typed, found[0]) if found[0].silence is None else only_silent(typed, found[0])
        if found:
            return ambiguous(typed, found)
        of_table = [each for each in self._senders if _has(plain(typed), each.name, *each.names)]
        return absent(typed, of_table[0], self._shelf) if len(of_table) == 1 else unknown(typed, self._all_names())

    def find(self, text: str, limit: int = LOOKED_AT) -> tuple[TargetCandidate, ...]:
        """Return what a text may mean as one types it, best first: a whole name, parts, then what is silent."""
        typed = " ".join(text.split())
        found: dict[str, TargetCandidate] = {}
        for each in self._parts(typed):
            found.setdefault(each.target.name if each.hit is None else each.text, each)
            if len(found) >= limit:
                break
        exact = self._exactly(typed) if found else None
        first = None if exact is None else exact.found
        return tuple(sorted(found.values(), key=lambda each: each.silence is not None and each != first))

    def matcher(self, text: str) -> Callable[[ElementSet], bool]:
        """Return what tells whether a satellite has a text in one of its names, or as its number."""
        wanted, number, numbers = plain(text), text.strip(), self.numbers(text)
        return lambda one: wanted in plain(one.name) or one.norad_id in numbers or str(one.norad_id) == number

    def numbers(self, text: str) -> frozenset[int]:
        """Return the catalogue numbers of those in the table of downlinks with a text in one of their names."""
        wanted = plain(text)
        return frozenset(s.norad_id for s in self._senders if s.norad_id and _has(wanted, s.name, *s.names))

    def other_names(self, norad_id: int, name: str) -> tuple[str, ...]:
        """Return what else a satellite of a catalogue is called by the table of downlinks."""
        return tuple(other for s in self._senders if s.is_of(norad_id, name) for other in (s.name, *s.names))

    def sender(self, text: str) -> NamedSender | None:
        """Return who in the table of downlinks is called that, in the catalogue or not; None if no entry is."""
        return next((each for each in self._senders if each.is_called(plain(text))), None)

    def silence_words(self, norad_id: int, name: str) -> str:
        """Return the sentence for a satellite that is off the air; empty for one that is not known to be."""
        silence = self._silence_of(norad_id, name)
        return "" if silence is None else silence.words(name)

    def silence_brief(self, norad_id: int, name: str) -> str:
        """Return the same for a row: `silent since 2025-08-13`."""
        silence = self._silence_of(norad_id, name)
        return "" if silence is None else silence.brief

    # --- whole names

    def _exactly(self, typed: str) -> Resolution | None:
        """Return what bears this name, or that two do, or that it is known but absent; None if nothing does."""
        wanted = plain(typed)
        star, satellite = self._star(wanted), self._satellite(typed)
        if star is not None and satellite is not None:
            return ambiguous(typed, (satellite, star))
        found = self._body(wanted) or star or satellite or self._slot(wanted)
        if found is not None:
            return Resolution(typed, found, exact=True)
        meant = [each for each in self._senders if each.is_called(wanted)]
        for sender in meant:
            found = self._of_sender(sender)
            if found is not None:
                return Resolution(typed, found, exact=True)
        if any(each.norad_id for each in meant):
            return absent(typed, meant[0], self._shelf)
        parts = [hit for hit in self._search(typed) if wanted in names_of(hit.elements.name)]
        if len({hit.elements.norad_id or hit.elements.name for hit in parts}) == 1:
            return Resolution(typed, self._candidate(_newest(parts)), exact=True)
        return None if parts or not meant or self._search(typed) else absent(typed, meant[0], self._shelf)

    @staticmethod
    def _body(wanted: str) -> TargetCandidate | None:
        return TargetCandidate(BodyTarget(BODIES[wanted]), wanted) if wanted in BODIES else None

    @staticmethod
    def _star(wanted: str) -> TargetCandidate | None:
        return next((_star(each) for each in stars() if wanted in map(plain, (each.name, *each.aliases))), None)

    @staticmethod
    def _slot(wanted: str) -> TargetCandidate | None:
        named = [slot for slot in slots() if wanted in map(plain, (slot.name, *slot.aliases))]
        return _slot(named[0]) if len(named) == 1 else None

    def _satellite(self, typed: str) -> TargetCandidate | None:
        """Return the satellite of exactly that number or name; of several with one name the newest elements."""
        hits = self._search(typed)
        if typed.isdecimal():
            same = [hit for hit in hits if hit.elements.norad_id == int(typed)]
        else:
            same = [hit for hit in hits if plain(hit.elements.name) == plain(typed)]
        return self._candidate(_newest(same)) if same else None

    def _of_sender(self, sender: NamedSender) -> TargetCandidate | None:
        """Return a satellite of the table as the catalogue has it, else its place on the arc; None for neither."""
        if sender.norad_id:
            same = [hit for hit in self._search(str(sender.norad_id)) if hit.elements.norad_id == sender.norad_id]
        else:
            names = [name for name in (sender.name, *sender.names) if "*" not in name]
            same = [hit for name in names for hit in self._search(name) if names_of(hit.elements.name) & {plain(name)}]
        if same:
            return self._candidate(_newest(same))
        if sender.longitude_deg is not None:
            place = slot_at(sender.longitude_deg)
            return TargetCandidate(place, place.slot.label.replace("°", ""), silence=sender.silence)
        return None

    # --- parts of names

    def _parts(self, typed: str) -> Iterator[TargetCandidate]:
        wanted = plain(typed)
        if not wanted:
            return
        exact = self._exactly(typed)
        if exact is not None and exact.found is not None:
            yield exact.found
        yield from (TargetCandidate(BodyTarget(body), key) for key, body in BODIES.items() if key.startswith(wanted))
        yield from map(self._candidate, self._search(typed))
        if len(wanted) < LEAST_PART:
            return
        for sender in self._senders:
            if any(wanted in name for name in sender.plain_names):
                found = self._of_sender(sender)
                if found is not None:
                    yield found
        yield from (
            _slot(slot) for slot in slots() if _has(wanted, slot.label, slot.name, *slot.aliases, *slot.networks)
        )
        yield from (_star(star) for star in stars() if _has(wanted, star.name, *star.aliases))

    def _search_shelf(self, typed: str) -> Sequence[Hit]:
        return () if self._shelf is None else self._shelf.search(typed, LOOKED_AT)

    def _candidate(self, hit: Hit) -> TargetCandidate:
        elements = hit.elements
        silence = self._silence_of(elements.norad_id, elements.name)
        text = str(elements.norad_id) if elements.norad_id else elements.name
        return TargetCandidate(Satellite(elements, hit.time_offset_s or 0.0), text, hit, silence)

    def _silence_of(self, norad_id: int, name: str) -> OffAir | None:
        return next((each.silence for each in self._senders if each.silence and each.is_of(norad_id, name)), None)

    def _all_names(self) -> Iterator[str]:
        """Yield every name that would have been understood."""
        yield from (body.name for body in BODIES.values())
        yield from (name for star in stars() for name in (star.name, *star.aliases))
        yield from (name for slot in slots() for name in (slot.name, *slot.aliases))
        yield from (name for each in self._senders for name in (each.name, *each.names) if "*" not in name)
        if self._shelf is not None:
            yield from self._shelf.names()


@lru_cache(maxsize=1)
def _shipped_senders() -> tuple[NamedSender, ...]:
    return senders(shipped())


def _newest(hits: Sequence[Hit]) -> Hit:
    now = datetime.now(UTC)
    return max(hits, key=lambda hit: (not is_ahead(hit.elements.epoch, now), hit.elements.epoch))


def _slot(slot: Slot) -> TargetCandidate:
    return TargetCandidate(SlotTarget(slot), slot.label.replace("°", ""))


def _star(star: NamedStar) -> TargetCandidate:
    return TargetCandidate(Star(star.name, star.ra_deg, star.dec_deg), star.name)


def _has(wanted: str, *names: str) -> bool:
    return any(wanted in plain(name) for name in names)
