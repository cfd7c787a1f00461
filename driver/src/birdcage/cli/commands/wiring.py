"""`birdcage wiring`."""

from __future__ import annotations

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options

WIDTH = 80


@click.command("wiring", epilog=EPILOG)
@click.argument("plug", required=False)
@global_options("json", "verbose")
def command(plug: str | None) -> None:
    """Print which wire goes where, what a wrong one looks like, and which adapters work.

    PLUG is one of those that it prints, or `adapters`. No dish is needed, and no port is opened.
    """
    from dataclasses import asdict

    from birdcage.cli.say import tell, tell_json
    from birdcage.setup import wiring
    from birdcage.setup.wiring_text import adapter_lines, wiring_lines

    adapters = plug == "adapters"
    try:
        connectors = () if adapters else wiring.connectors() if plug is None else (wiring.connector(plug),)
    except KeyError as unknown:
        raise click.UsageError(f"{unknown.args[0]}, adapters") from None
    if flags().json:
        tell_json(
            {
                "plugs": [
                    {**asdict(each), "drawing": each.drawing.value, "firmwares": wiring.spoken_behind(each)}
                    for each in connectors
                ],
                "adapters": [asdict(each) for each in wiring.adapters()],
                "lines": (wiring.FOUR_WIRES, *wiring.LINES, *wiring.BIAS),
                "cautions": wiring.CAUTIONS,
                "symptoms": [{**asdict(each), "saw": each.saw.value} for each in wiring.symptoms()],
            }
        )
        return
    for line in adapter_lines(WIDTH) if adapters else wiring_lines(connectors, WIDTH):
        tell(line)
