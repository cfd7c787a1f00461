"""Render the app in given states, at a size and in a theme, to SVG, PNG and text: `render_page.py OUT [STATE ...]`."""

from __future__ import annotations

import argparse
import asyncio
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "tui"))

import picture
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.paths import throw_away_paths
from birdcage.station.build import open_session
from birdcage_tui.app import BirdcageApp
from birdcage_tui.run import DEMO_PLACE, DEMO_PORT
from birdcage_tui.settings import AppSettings
from birdcage_tui.themes import LOOKS

STEP_S = 0.1
FONT, FONTS = "DejaVu Sans Mono", Path("/usr/share/fonts/truetype/dejavu")


def to_png(svg: str) -> bytes:
    """Return the picture as pixels. Its text needs a font; lines and dots are shapes already."""
    import resvg_py

    files = [str(path) for path in sorted(FONTS.glob("DejaVuSansMono*.ttf"))]
    return bytes(resvg_py.svg_to_bytes(svg_string=svg, font_files=files, font_family=FONT))


def to_svg(app: BirdcageApp) -> str:
    """Return what stands on the screen."""
    strips = app.screen._compositor.render_strips()  # noqa: SLF001 - the only way to the cells
    rows = [[(segment.text, segment.style) for segment in strip] for strip in strips]
    return picture.svg(rows, LOOKS[app.theme].ground)


def ink(png_text: str) -> int:
    """Return how many visible characters a screen's text holds: an empty picture is a failed one."""
    return sum(not char.isspace() for char in png_text)


async def demo(seconds: float, size: tuple[int, int], theme: str) -> tuple[str, str]:
    """Return the SVG and the text of the real demo so many seconds after its start, on a virtual clock."""
    with throw_away_paths() as paths:
        session = open_session(
            port=DEMO_PORT, firmware="g2", baud=None, settings=Settings(), paths=paths, clock=VirtualClock()
        )
        session.start = lambda: None  # stepped here instead of running on its thread
        app = BirdcageApp(session, AppSettings(theme=theme, place=DEMO_PLACE, tour=True))
        async with app.run_test(size=size) as pilot:
            for _ in range(round(seconds / STEP_S)):
                session.step(STEP_S)
                await pilot.pause()
                app._tick()  # noqa: SLF001 - its timer runs in real time
            app.paint()
            await pilot.pause()
            found = to_svg(app), stand_in.text_of(app)
        session.close()
    return found


async def shown(name: str, size: tuple[int, int], theme: str, keys: list[str]) -> tuple[str, str]:
    """Return the SVG and the text of the app in a state of the stand-in."""
    app = stand_in.app_in(name, theme=theme)
    async with app.run_test(size=size) as pilot:
        await pilot.pause()
        if keys:
            await pilot.press(*keys)
            await pilot.pause()
        app.paint()
        await pilot.pause()
        return to_svg(app), stand_in.text_of(app)


def main() -> int:
    """Write the pictures and say how much ink each holds."""
    parse = argparse.ArgumentParser(description=__doc__)
    parse.add_argument("out", type=Path)
    parse.add_argument("states", nargs="*", default=[], help=", ".join(stand_in.STATES))
    parse.add_argument("--size", default="80x24")
    parse.add_argument("--theme", default="dusk")
    parse.add_argument("--keys", default="", help="keys to press first, with commas")
    parse.add_argument("--demo", type=float, metavar="SECONDS", help="instead of states: the demo, so long after start")
    options = parse.parse_args()
    width, height = map(int, options.size.split("x"))
    options.out.mkdir(parents=True, exist_ok=True)
    names = ["demo"] if options.demo is not None else options.states or stand_in.STATES
    for name in names:
        keys = [key for key in options.keys.split(",") if key]
        if options.demo is None:
            svg, text = asyncio.run(shown(name, (width, height), options.theme, keys))
        else:
            svg, text = asyncio.run(demo(options.demo, (width, height), options.theme))
        stem = options.out / f"{name}-{options.size}-{options.theme}"
        stem.with_suffix(".svg").write_text(svg)
        stem.with_suffix(".png").write_bytes(to_png(svg))
        stem.with_suffix(".txt").write_text(text)
        print(f"{stem.name}: {ink(text)} characters of ink")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
