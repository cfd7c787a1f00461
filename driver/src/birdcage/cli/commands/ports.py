"""`birdcage ports`."""

from __future__ import annotations

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options


@click.command("ports", epilog=EPILOG)
@global_options("json", "verbose")
def command() -> None:
    """List the serial ports of this machine: device, what it is, USB identity, lasting name."""
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.station.known import list_ports

    ports = list_ports()
    if flags().json:
        tell_json(
            [
                {"device": p.device, "description": p.description, "usb_identity": p.identity, "by_id": p.by_id}
                for p in ports
            ]
        )
        return
    for port in ports:
        tell("\t".join(each or "-" for each in (port.device, port.description, port.identity, port.by_id)))
    if not ports:
        say("No serial port is plugged in. Without a dish: `birdcage sim`.")
