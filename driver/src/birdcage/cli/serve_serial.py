"""`birdcage serve --easycomm`: a port for programs that know only a serial one."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from birdcage.base.errors import ConfigError
from birdcage.cli.options import Wanted, flags

if TYPE_CHECKING:
    from birdcage.cli.station_command import StationCommand


def serve_serial(dish: StationCommand, wants: Wanted, link: Path | None) -> NoReturn:
    """Serve until a signal ends it. ConfigError where there are no pseudo terminals, or no link can be made."""
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.station_run import run_station
    from birdcage.rotctld.options import options_from

    try:
        from birdcage.rotctld.easycomm_port import EasycommPort
        from birdcage.rotctld.easycomm_service import EasycommService
    except ImportError as error:
        raise ConfigError("This system has no pseudo terminals. Serve the network: `birdcage serve`.") from error
    port, as_json = EasycommPort(link), flags().json
    service = EasycommService(dish.station, port, options_from(wants.settings), say)
    if as_json:
        tell_json({"v": 1, "type": "Serving", "port": port.path, "link": None if link is None else str(link)})
    say(f"EasyComm at {port.path if link is None else f'{link} ({port.path})'}. Any baud rate will do. Ctrl+C ends it.")

    def check() -> None:
        if service.crash is not None:
            raise service.crash

    with ExitStack() as stack:
        service.start()
        stack.callback(service.shutdown)
        run_station((dish,), as_json=as_json, each_time=check)
