"""Take every picture of the README from the demo, each time the same: `capture_screenshots.py [--check] [NAME ...]`.

Writes SVG and PNG into `screenshots/`, of the one that moves only SVG. `--check` writes nothing, and fails where the
committed SVG is another. A scene in which what must be readable is not fails, too.
"""

from __future__ import annotations

import argparse
import asyncio
import re
import sys
from pathlib import Path

import moving
import picture
import scenes
import stage
from birdcage_tui.drawing.themes import LOOKS

FOLDER = Path(__file__).resolve().parents[1] / "screenshots"
GAP = 24


async def take(scene: scenes.Scene) -> str:
    """Play a scene and return its picture."""
    async with stage.demo(scene.size, scene.theme, tour=scene.tour) as on:
        await scene.play(on)
        must_read(scene.name, scene.seen, on.text())
        return on.svg()


async def take_frames(scene: scenes.MovingScene) -> list[stage.Rows]:
    """Play a scene that moves and return its screens."""
    async with stage.demo(scene.size, scene.theme, tour=True) as on:
        await scene.begin(on)
        screens = []
        for _ in range(scene.frames):
            must_read(scene.name, scene.seen, on.text())
            screens.append(stage.rows_of(on.app))
            await on.wait(scene.every_s)
        return screens


def must_read(name: str, seen: tuple[str, ...], text: str) -> None:
    """End the program where something that must be readable is not."""
    missing = [words for words in seen if words not in text]
    if missing:
        sys.exit(f"{name}: {', '.join(missing)} cannot be read in this picture:\n{text}")


def take_moving(scene: scenes.MovingScene) -> str:
    """Return the picture that moves."""
    screens = asyncio.run(take_frames(scene))
    return moving.moving(screens, LOOKS[scene.theme].ground, scene.shown_s)


def size_of(svg: str) -> tuple[int, int]:
    """Return width and height in pixels."""
    found = re.search(r'width="(\d+)" height="(\d+)"', svg)
    assert found is not None, "ours have both"
    return int(found[1]), int(found[2])


def collage(svgs: list[str]) -> str:
    """Return the pictures as one, two in a row, each scaled to the same width."""
    width = max(size_of(svg)[0] for svg in svgs)
    heights = [size_of(svg)[1] * width / size_of(svg)[0] for svg in svgs]
    rows = [max(heights[i : i + 2]) for i in range(0, len(svgs), 2)]
    wide, high = 2 * width + 3 * GAP, sum(rows) + (len(rows) + 1) * GAP
    parts, y = [], GAP
    for index, svg in enumerate(svgs):
        place = f'x="{GAP + index % 2 * (width + GAP)}" y="{y:g}" width="{width}" height="{heights[index]:g}"'
        parts.append(re.sub(r'width="\d+" height="\d+"', place, svg, count=1))
        if index % 2:
            y += rows[index // 2] + GAP
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high:.0f}" viewBox="0 0 {wide} {high:.0f}">'
    )
    return "\n".join((head, '<rect width="100%" height="100%" fill="#20262d"/>', *parts, "</svg>\n"))


def write(name: str, svg: str) -> None:
    """Write both forms; what moves does so in one of them only."""
    FOLDER.mkdir(exist_ok=True)
    FOLDER.joinpath(f"{name}.svg").write_text(svg)
    if name == scenes.MOVING.name:
        print(f"{name}: {len(svg) // 1024} kB")
        return
    pixels = picture.png(svg)
    FOLDER.joinpath(f"{name}.png").write_bytes(pixels)
    print(f"{name}: {len(pixels) // 1024} kB")


def is_stale(name: str, svg: str) -> bool:
    """Say whether the committed picture is missing or another than the one just taken."""
    file = FOLDER / f"{name}.svg"
    has_both = name == scenes.MOVING.name or file.with_suffix(".png").exists()
    return not has_both or not file.exists() or file.read_text() != svg


def main() -> None:
    parse = argparse.ArgumentParser(description=__doc__)
    names = [scenes.MOVING.name, *(scene.name for scene in scenes.SCENES)]
    parse.add_argument("--check", action="store_true", help="write nothing; fail where a committed picture is stale")
    parse.add_argument("names", nargs="*", help=", ".join(names))
    options = parse.parse_args()
    wanted = options.names or names
    stage.make_repeatable()
    taken = {scene.name: asyncio.run(take(scene)) for scene in scenes.SCENES if scene.name in wanted}
    if scenes.MOVING.name in wanted:
        taken[scenes.MOVING.name] = take_moving(scenes.MOVING)
    if set(scenes.COLLAGE) <= set(taken):
        taken["tui-collage"] = collage([taken[name] for name in scenes.COLLAGE])
    if options.check:
        stale = [name for name, svg in taken.items() if is_stale(name, svg)]
        if stale:
            sys.exit(f"stale: {', '.join(stale)}. Run scripts/capture_screenshots.py, look at them, commit them.")
        return
    for name, svg in taken.items():
        write(name, svg)
    print("not built yet, so no picture:", ", ".join(scenes.NOT_BUILT))


if __name__ == "__main__":
    main()
