"""What is told of the selected pass beside or under its map: blocks of lines, each of them whole or left out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from birdcage_tui.drawing.cell_text import cell_len, cut, wrap
from birdcage_tui.passes.figures import away, clock_lines, doppler_at, signal_lines, sun_lines
from birdcage_tui.shown.pass_words import (
    EDGES,
    EVENT_WORDS,
    clock_text,
    count_text,
    length_text,
    reach_sign,
    reach_text,
    standing_text,
)

if TYPE_CHECKING:
    from birdcage.base.beam import Beam

    from birdcage_tui.shown.sky_picture import ShownPass

LINES = 5
"""Rows under the map."""
WITH_RANGE, WITH_DOPPLER = 29, 44
"""Columns from which on range, and Doppler too, stand behind azimuth."""

Lines = list[tuple[str, str]]
"""Ink and words."""


class TextBlock(NamedTuple):
    """Lines that stand together."""

    forms: list[Lines]
    """From all of it to the least."""
    rank: int = 0
    """What has a lower one gets its room first."""


@dataclass(frozen=True, slots=True)
class PassText:
    """One pass at one moment. `everything`: range, Doppler, clock, Sun and signal too, as no other pane shows them."""

    row: ShownPass
    t_s: float
    moment: str
    """`now` or `then`."""
    beam: Beam | None
    everything: bool = True

    def lines(self, width: int, room: int, *, beside: bool) -> Lines:
        """Return the lines for so many columns and rows: of each block its first form that fits whole."""
        blocks = self._beside(width) if beside else self._under(width)
        chosen: dict[int, Lines] = {}
        for index in sorted(range(len(blocks)), key=lambda index: blocks[index].rank):
            for form in blocks[index].forms:
                lines = [(ink, each) for ink, words in form for each in wrap(words, width, indent="  ") or [""]]
                if len(lines) <= room:
                    chosen[index] = lines
                    room -= len(lines)
                    break
        return [line for index in sorted(chosen) for line in chosen[index]]

    def _under(self, width: int) -> list[TextBlock]:
        """Return the blocks for a few narrow rows."""
        row = self.row
        rise = "" if row.already_up else f"{clock_text(row.aos_s, seconds=False)} "
        fall = "later" if row.still_up else clock_text(row.los_s, seconds=False)
        span = f"{'' if row.stays else f'up {rise}to {fall}, '}max {row.max_el_deg:.0f}°"
        age = [form for form in self._elements()[-1:] if cell_len(form[0][1]) <= width]
        return [TextBlock([[*self._who(width), ("text", _held(row)), ("dim", span)]]), TextBlock(age)]

    def _beside(self, width: int) -> list[TextBlock]:
        """Return the blocks beside the map: when and where it rises and sets, what is in reach, then the rest."""
        row = self.row
        place = row.path.at(self.t_s)
        where = "" if place is None else f"{self.moment} AZ {place[0]:.1f}°  EL {place[1]:.1f}°"
        blocks = [
            TextBlock([[*self._who(width), ("text", where)]]),
            TextBlock([self._events(width)]),
            TextBlock([[("text", _held(row))]]),
        ]
        if row.reach.lost or not row.stays:
            spans = [
                ("text", f"  {clock_text(one.start_s)} to {clock_text(one.end_s)}") for one in row.reach.intervals[:3]
            ]
            blocks.append(TextBlock([spans]))
        blocks.append(TextBlock(self._elements()))
        if row.hears:
            blocks.append(TextBlock([[("text", f"sends {row.hears}")]]))
        if self.everything:
            blocks.append(TextBlock([signal_lines(row)], 2))
        blocks += [TextBlock([[line]]) for line in _losses(row, edges=False)]
        if self.everything:
            blocks += [TextBlock([lines], 1) for lines in self._rest(width)]
        return blocks + [TextBlock([[line]], 3) for line in _losses(row, edges=True)]

    def _who(self, width: int) -> Lines:
        """Return which satellite it is, and what comes next."""
        row = self.row
        name = f"{'★ ' if row.favourite else ''}{row.name}"
        number = f"  {row.norad_id}" if row.norad_id else ""
        event = row.next_event(self.t_s)
        words = standing_text(row) if event is None else f"{EVENT_WORDS[event[1]]} in {count_text(event[0] - self.t_s)}"
        return [
            ("strong", f"{name}{number}" if cell_len(name + number) <= width else cut(name, width)),
            ("target", words),
        ]

    def _events(self, width: int) -> Lines:
        """Return when and where it rises, is highest and sets; with range and Doppler where there is room."""
        row = self.row
        known = self._has_range()
        if row.stays:
            return [("dim", f"max {row.max_el_deg:.1f}° at {clock_text(row.tca_s, seconds=False)}")]
        lines, gap = [], " " if known and WITH_RANGE <= width < WITH_DOPPLER else "  "
        for event, at_s, az_deg, seen in (
            ("AOS", row.aos_s, row.aos_az_deg, not row.already_up),
            ("TCA", row.tca_s, row.tca_az_deg, True),
            ("LOS", row.los_s, row.los_az_deg, not row.still_up),
        ):
            words = f"{clock_text(at_s)}{gap}{az_deg:5.1f}°" if seen else "already up" if event == "AOS" else "later"
            if seen and known and width >= WITH_RANGE:
                range_text, doppler = away(row, at_s)
                words += f" {range_text:>8}" + (f"{doppler:>13}" if width >= WITH_DOPPLER else "")
            lines.append(("dim", f"{event}  {words}"))
        if known and width >= WITH_DOPPLER:
            lines.append(("dim", f"     Doppler at {doppler_at(row)}"))
        return [*lines, ("dim", f"max {row.max_el_deg:.1f}°, {length_text(row.los_s - row.aos_s)} up")]

    def _has_range(self) -> bool:
        """Return whether range and Doppler are known, and are told here."""
        return self.everything and bool(self.row.path.range_km)

    def _rest(self, width: int) -> list[Lines]:
        """Return range and Doppler where they do not stand above, then clock and Sun."""
        row = self.row
        blocks: list[Lines] = []
        if self._has_range() and (width < WITH_DOPPLER or row.stays):
            (first, rising), (nearest, still), (last, falling) = (
                away(row, each) for each in (row.aos_s, row.tca_s, row.los_s)
            )
            at = f"at {doppler_at(row)}"
            if row.stays:
                blocks.append([("dim", f"range {nearest}, Doppler {still} {at}")])
            else:
                if width < WITH_RANGE:
                    blocks.append([("dim", f"range AOS {first}, TCA {nearest}, LOS {last}")])
                shift = f"Doppler {rising.removesuffix(' kHz')} to {falling}"
                blocks.append([("dim", shift), ("dim", f"  {at}")])
        sun = ", ".join(words for _, words in sun_lines(row, self.beam))
        blocks.append(clock_lines(row))
        blocks.append([(sun_lines(row, self.beam)[-1][0], sun)] if sun else [])
        return blocks

    def _elements(self) -> list[Lines]:
        """Return what the elements are worth: in full, else their age alone."""
        age = self.row.age
        brief = age.words.partition(", ")[0]
        return [
            [(age.ink, f"{age.glyph} elements {words}")]
            for words in (age.words, brief if age.short in brief else age.short)
        ]


def _held(row: ShownPass) -> str:
    """Return how much of it is in reach, or why nothing."""
    if not row.reach.intervals:
        return f"{'always out of' if row.stays else 'never in'} reach: {reach_sign(row.reach)[2]}"
    if row.stays and not row.reach.lost:
        return "always in reach"
    return f"{'in parts' if row.stays else reach_text(row)} in reach, best {row.reach.best_el_deg or 0.0:.0f}°"


def _losses(row: ShownPass, *, edges: bool) -> Lines:
    """Return each part in which the dish cannot follow; those at the ends, or the others."""
    return [
        ("dim", f"{lost.cause.words} {clock_text(lost.start.timestamp())}, {length_text(lost.duration_s)}")
        for lost in row.reach.lost if lost.duration_s >= 1.0 and (lost.reason in EDGES) == edges
    ]  # fmt: skip
