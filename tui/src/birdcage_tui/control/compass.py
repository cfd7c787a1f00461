"""The geometry of the compass rose: north up, east right, in dots."""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.drawing.dial import Dial


@dataclass(frozen=True, slots=True)
class Compass(Dial):
    """A round dial in the middle of `width` by `height` cells."""

    @property
    def middle(self) -> tuple[float, float]:
        """The hub, in dots."""
        return float(self.width // 2 * 2 + 0.5), float(self.height * 2 + 0.5)

    def dot(self, az_deg: float, part: float = 1.0) -> tuple[float, float]:
        """Return the dot in a direction, at a part of the radius."""
        x, y = self.middle
        az = math.radians(az_deg)
        return x + self.radius * part * math.sin(az), y - self.radius * part * math.cos(az) / self.dot_aspect

    def cell(self, az_deg: float, part: float = 1.0) -> tuple[int, int]:
        """Return the cell of that dot."""
        x, y = self.dot(az_deg, part)
        return math.floor(x / 2), math.floor(y / 4)

    def direction(self, column: int, row: int) -> float | None:
        """Return the azimuth of a cell; None on the hub and outside the rim."""
        x0, y0 = self.middle
        dx, dy = column * 2 + 1 - x0, (row * 4 + 2 - y0) * self.dot_aspect
        reach = math.hypot(dx, dy)
        return None if reach < 3 or reach > self.radius + 6 else math.degrees(math.atan2(dx, -dy)) % 360

    def ticks(self, canvas: Braille) -> None:
        """Draw the rim and its ticks: every 30 degrees long, every 10 short, every 5 shorter where there is room."""
        canvas.circle(*self.middle, self.radius, "dim", dot_aspect=self.dot_aspect)
        fine = 5 if self.radius >= 50 else 10
        for az_deg in range(0, 360, fine):
            part, least = (0.1, 5.0) if az_deg % 30 == 0 else (0.055, 3.0) if az_deg % 10 == 0 else (0.03, 2.0)
            length = max(least, min(self.radius * part, 10.0))
            canvas.line(*self.dot(az_deg, 1 - 1.5 / self.radius), *self.dot(az_deg, 1 - length / self.radius), "dim")

    def arc(self, canvas: Braille, az_deg: float, way_deg: float, part: float, ink: str, spacing: float) -> None:
        """Draw the turn from an azimuth through `way_deg` as dots along a circle."""
        count = max(2, round(abs(math.radians(way_deg)) * self.radius * part))
        canvas.dotted([self.dot(az_deg + way_deg * step / count, part) for step in range(count + 1)], ink, spacing)

    def hatch(
        self, canvas: Braille, ink: str, az_deg: float, span_deg: float, inner: float, outer: float, every: int = 6
    ) -> None:
        """Fill a sector clockwise from an azimuth, between two parts of the radius, with thin diagonals."""
        x0, y0 = self.middle
        count = max(2, math.ceil(span_deg / 5))
        edge = [self.dot(az_deg + span_deg * k / count, part) for k in range(count + 1) for part in (inner, outer)]
        left, right = (round(pick(x for x, _ in edge) - x0) for pick in (min, max))
        top, bottom = (round(pick(y for _, y in edge) - y0) for pick in (min, max))
        for row in range(top - 1, bottom + 2):
            dy = row * self.dot_aspect
            for dx in range(left - 1, right + 2):
                if (dx + row) % every or not inner <= math.hypot(dx, dy) / self.radius <= outer:
                    continue
                if (math.degrees(math.atan2(dx, -dy)) - az_deg) % 360 <= span_deg:
                    canvas.dot(x0 + dx, y0 + row, ink)
