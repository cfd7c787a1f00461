"""Cut the coastline out of Natural Earth's countries, 1:110 million, as the PyPI package `geopandas` 0.14 carries them.

    pip download --no-deps geopandas==0.14.4
    scripts/cut_coastline.py geopandas-0.14.4-py3-none-any.whl

Writes `sky/data/coastline.txt`. Neighbours share the points of their border, so the coast is each edge that one
country alone has. The package is for this script alone: birdcage neither needs nor installs it.
"""

import struct
import sys
import zipfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

TARGET = Path(__file__).parents[1] / "driver/src/birdcage/sky/data/coastline.txt"
SHAPES = "geopandas/datasets/naturalearth_lowres/naturalearth_lowres.shp"
POLYGON = 5
EDGE_OF_MAP = 18000
"""The antimeridian, in hundredths of a degree: countries are cut there, no coast runs along it."""
POLE = -9000
HEADER = """\
# The coastlines of the world. Made with Natural Earth, 1:110 million (naturalearthdata.com), public domain.
# Cut by scripts/cut_coastline.py from the PyPI package geopandas VERSION.
# One line each: longitude and latitude in hundredths of a degree, then from each point to the next.
"""
Point = tuple[int, int]
Edge = tuple[Point, Point]


def rings(shapes: bytes) -> Iterator[list[Point]]:
    """Yield the rings of a file of polygons (ESRI Shapefile Technical Description, July 1998)."""
    at = 100
    while at < len(shapes):
        (words,) = struct.unpack_from(">i", shapes, at + 4)
        kind, parts, points = struct.unpack_from("<i32x2i", shapes, at + 8)
        if kind != POLYGON:
            raise SystemExit(f"shape of kind {kind} at byte {at}: not a file of polygons")
        starts = [*struct.unpack_from(f"<{parts}i", shapes, at + 52), points]
        numbers = struct.unpack_from(f"<{2 * points}d", shapes, at + 52 + 4 * parts)
        where = [(round(x * 100), round(y * 100)) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
        for start, end in pairwise(starts):
            yield where[start:end]
        at += 8 + 2 * words


def coast(shapes: bytes) -> list[Edge]:
    """Return the edges that belong to one country alone, in the order of the file."""
    edges = [edge for ring in rings(shapes) for edge in pairwise(ring) if edge[0] != edge[1]]
    count = Counter(tuple(sorted(edge)) for edge in edges)

    def real(edge: Edge) -> bool:
        (x0, y0), (x1, y1) = edge
        return not (abs(x0) == abs(x1) == EDGE_OF_MAP or y0 == y1 == POLE)

    return [edge for edge in edges if count[tuple(sorted(edge))] == 1 and real(edge)]


def joined(edges: list[Edge]) -> list[list[Point]]:
    """Return lines that hold each edge once, as long as they can be."""
    following: dict[Point, list[Point]] = defaultdict(list)
    for start, end in edges:
        following[start].append(end)
    ends = Counter(end for _, end in edges)
    # Open lines from their beginnings first; what is left is closed.
    order = sorted(following, key=lambda point: ends[point] > 0)
    lines = []
    for first in order:
        while following[first]:
            line = [first]
            while following[line[-1]]:
                line.append(following[line[-1]].pop())
            lines.append(line)
    return lines


def main(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        edges = coast(archive.read(SHAPES))
    lines = joined(edges)
    rows = []
    for line in sorted(lines, key=len, reverse=True):
        steps = [number for (x0, y0), (x1, y1) in pairwise(line) for number in (x1 - x0, y1 - y0)]
        rows.append(" ".join(map(str, (*line[0], *steps))))
    version = wheel.name.split("-")[1]
    TARGET.write_text(HEADER.replace("VERSION", version) + "\n".join(rows) + "\n", encoding="ascii")
    print(f"{len(lines)} lines, {len(edges)} edges, {TARGET.stat().st_size} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
