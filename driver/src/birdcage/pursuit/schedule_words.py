"""Why a pass is left out, or cut short, in a few words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from birdcage.pursuit.schedule_piece import Piece, Turning

if TYPE_CHECKING:
    from birdcage.base.config.tracking_sections import AutotrackSettings


def below_minima(piece: Piece, rules: AutotrackSettings) -> str:
    """Return why a piece is not worth following: silent, or which minimum it does not reach; else an empty text."""
    if piece.candidate.silence:
        return piece.candidate.silence
    followed_s = piece.followed.total_seconds()
    if followed_s < rules.min_duration_s:
        return f"{followed_s:.0f} s within reach, under {rules.min_duration_s:g} s"
    if piece.best_el_deg < rules.min_elevation_deg:
        return f"up to {piece.best_el_deg:.1f}° within reach, under {rules.min_elevation_deg:g}°"
    return ""


def left_out(piece: Piece, rest: Piece | None, settled: Sequence[Piece]) -> str:
    """Return why a pass is left out of which settled ones leave too little: the `rest`, or nothing."""
    words = f"overlaps {_named(_nearest(piece, settled))}"
    if rest is None:
        return words
    return f"{words}, which leaves {rest.followed.total_seconds():.0f} s, up to {rest.best_el_deg:.1f}°"


def cut_short(piece: Piece, settled: Sequence[Piece]) -> str:
    """Return for whom a piece that is followed is less than its pass; an empty text where it is all of it."""
    words = []
    if piece.late:
        before = [each for each in settled if each.end <= piece.start]
        words.append(f"joined after {_named(before[-1])}")
    if piece.short:
        after = [each for each in settled if each.start >= piece.end]
        words.append(f"cut short for {_named(after[0])}")
    return ", ".join(words)


def overlapped(piece: Piece, kept: Sequence[Piece], turning: Turning) -> str:
    """Return which of the passes of the same priority that were chosen stands in the way of one that was not."""
    in_the_way = [each for each in kept if not turning.follows(each, piece) and not turning.follows(piece, each)]
    who = _nearest(piece, in_the_way)
    if who.end <= piece.start:
        return f"no time to turn round after {_named(who)}"
    if who.start >= piece.end:
        return f"no time to turn round for {_named(who)}"
    return f"overlaps {_named(who)}"


def _nearest(piece: Piece, others: Sequence[Piece]) -> Piece:
    """Return whom it overlaps most."""
    return max(others, key=lambda each: min(each.end, piece.end) - max(each.start, piece.start))


def _named(piece: Piece) -> str:
    passing = piece.candidate.passing
    return f"{passing.name or passing.norad_id} (priority {piece.candidate.priority})"
