"""The geometry of the sky plot: zenith in the middle, horizon at the rim, N up and E right."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.geometry import beside

from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.drawing.dial import Dial

if TYPE_CHECKING:
    from birdcage.base.beam import Beam

_BEAM_POINTS = 48


@dataclass(frozen=True, slots=True)
class Polar(Dial):
    """A disc in dots on a canvas of `width` by `height` cells."""

    @property
    def middle(self) -> tuple[float, float]:
        """The zenith, in dots."""
        return float(self.width // 2 * 2 + 0.5), float(self.height * 2)

    def dot(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the dot of a direction."""
        x, y = self.middle
        reach, az = self.radius * (90 - el_deg) / 90, math.radians(az_deg)
        return x + reach * math.sin(az), y - reach * math.cos(az) / self.dot_aspect

    def cell(self, az_deg: float, el_deg: float) -> tuple[int, int]:
        """Return the cell of a direction."""
        x, y = self.dot(az_deg, el_deg)
        return math.floor(x / 2), math.floor(y / 4)

    def direction(self, column: int, row: int) -> tuple[float, float] | None:
        """Return azimuth and elevation of a cell's middle; None outside the disc."""
        x0, y0 = self.middle
        dx, dy = column * 2 + 1 - x0, (row * 4 + 2 - y0) * self.dot_aspect
        reach = math.hypot(dx, dy) / self.radius
        return None if reach > 1 else (math.degrees(math.atan2(dx, -dy)) % 360, 90 * (1 - reach))

    def ring(self, canvas: Braille, el_deg: float, ink: str, spacing: float = 0.0) -> None:
        """Draw the circle of one elevation."""
        canvas.circle(*self.middle, self.radius * (90 - el_deg) / 90, ink, spacing, self.dot_aspect)

    def beam(self, canvas: Braille, az_deg: float, el_deg: float, beam: Beam, ink: str, least: float) -> None:
        """Draw where a beam that looks at a direction is at half power; nothing where it spans fewer dots than this."""
        if self.radius * max(beam.az_deg, beam.el_deg) / 90 < least:
            return
        angles = [2 * math.pi * step / _BEAM_POINTS for step in range(_BEAM_POINTS + 1)]
        edge = [
            beside(az_deg, el_deg, beam.az_deg / 2 * math.sin(angle), beam.el_deg / 2 * math.cos(angle))
            for angle in angles
        ]
        canvas.dotted([self.dot(az, el) for az, el in edge], ink, 1.0)

    def hatch(self, canvas: Braille, ink: str, el_low_deg: float, el_high_deg: float,
              az_from_deg: float = 0.0, az_span_deg: float = 360.0) -> None:  # fmt: skip
        """Fill the band between two elevations, clockwise from an azimuth, with thin diagonals."""
        x0, y0 = self.middle
        inner, outer = self.radius * (90 - el_high_deg) / 90, self.radius * (90 - el_low_deg) / 90
        across, down = math.ceil(outer), math.ceil(outer / self.dot_aspect)
        for row in range(-down, down + 1):
            dy = row * self.dot_aspect
            for dx in range(-across, across + 1):
                if (dx + row) % 8:
                    continue
                if not inner <= math.hypot(dx, dy) <= outer:
                    continue
                if (math.degrees(math.atan2(dx, -dy)) - az_from_deg) % 360 <= az_span_deg:
                    canvas.dot(x0 + dx, y0 + row, ink)


@dataclass(frozen=True, slots=True)
class WayDot:
    """One dot of a target's way."""

    dot: tuple[float, float]
    held: bool
    """Whether the dish can hold it there."""
    past: bool

    @property
    def look(self) -> tuple[str, float]:
        """Ink and spacing: bright and dense in reach, quiet outside, thin where it has been."""
        return "target" if self.held else "text", 3.5 if self.past else 1.0 if self.held else 2.4


def draw_way(canvas: Braille, way: Iterable[WayDot]) -> None:
    """Draw the way of a target as a dotted line, each piece in its look."""
    pieces: list[tuple[tuple[str, float], list[tuple[float, float]]]] = []
    for each in way:
        if pieces and pieces[-1][0] == each.look:
            pieces[-1][1].append(each.dot)
        else:
            pieces.append((each.look, [pieces[-1][1][-1], each.dot] if pieces else [each.dot]))
    for (ink, spacing), dots in pieces:
        canvas.dotted(dots, ink, spacing)
