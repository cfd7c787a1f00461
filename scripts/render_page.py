"""Render the app in given states, at a size and in a theme, to SVG, PNG and text: `render_page.py OUT [STATE ...]`."""

from __future__ import annotations

import argparse
import asyncio
from pathlib import Path

import picture
import stage
import stand_in
from birdcage_tui.drawing.themes import LOOKS


def ink(text: str) -> int:
    """Return how many visible characters a screen's text holds: an empty picture is a failed one."""
    return sum(not char.isspace() for char in text)


async def demo(
    seconds: float, size: tuple[int, int], theme: str, keys: list[str], after_s: float, firmware: str
) -> tuple[str, str]:
    """Return the SVG and the text of the real demo so many seconds after its start, and after the keys."""
    async with stage.demo(size, theme, tour=True, firmware=firmware) as on:
        await on.wait(seconds)
        await on.press(*keys)
        await on.wait(after_s)
        return on.svg(), on.text()


async def shown(
    name: str, size: tuple[int, int], theme: str, keys: list[str], glyphs: str = "braille"
) -> tuple[str, str]:
    """Return the SVG and the text of the app in a state of the stand-in."""
    import sky_stand_in  # `stage` has put the stand-ins on the path
    import track_stand_in

    made = track_stand_in.app_in if name in track_stand_in.SCENES else stand_in.app_in
    app = made(name, theme=theme, glyphs=glyphs, sky=sky_stand_in.make(), cell_aspect=picture.CELL_ASPECT)
    async with app.run_test(size=size) as pilot:
        await pilot.pause()
        if keys:
            await pilot.press(*keys)
            await pilot.pause()
        app.paint()
        await pilot.pause()
        rows = stage.rows_of(app)
        return picture.svg(rows, LOOKS[app.theme].ground), stand_in.text_of(app)


def main() -> int:
    """Write the pictures and say how much ink each holds."""
    parse = argparse.ArgumentParser(description=__doc__)
    parse.add_argument("out", type=Path)
    parse.add_argument("states", nargs="*", default=[], help=", ".join(stand_in.STATES))
    parse.add_argument("--size", default="80x24")
    parse.add_argument("--theme", default="dusk")
    parse.add_argument("--glyphs", default="braille")
    parse.add_argument("--firmware", default="g2", help="of the demo's dish")
    parse.add_argument("--keys", default="", help="keys to press first, with commas")
    parse.add_argument("--demo", type=float, metavar="SECONDS", help="instead of states: the demo, so long after start")
    parse.add_argument(
        "--after", type=float, default=0.0, metavar="SECONDS", help="in the demo: so long after the keys"
    )
    options = parse.parse_args()
    stage.make_repeatable()
    width, height = map(int, options.size.split("x"))
    options.out.mkdir(parents=True, exist_ok=True)
    names = ["demo"] if options.demo is not None else options.states or stand_in.STATES
    for name in names:
        keys = [key for key in options.keys.split(",") if key]
        if options.demo is None:
            svg, text = asyncio.run(shown(name, (width, height), options.theme, keys, options.glyphs))
        else:
            svg, text = asyncio.run(
                demo(options.demo, (width, height), options.theme, keys, options.after, options.firmware)
            )
        look = options.theme if options.glyphs == "braille" else f"{options.theme}-{options.glyphs}"
        stem = options.out / f"{name}-{options.size}-{look}"
        stem.with_suffix(".svg").write_text(svg)
        stem.with_suffix(".png").write_bytes(picture.png(svg))
        stem.with_suffix(".txt").write_text(text)
        print(f"{stem.name}: {ink(text)} characters of ink")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
