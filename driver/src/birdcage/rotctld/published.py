"""The server as it was published, for a script that has made its own antenna.

`docs/reference/published-interface.md` has what was published.
"""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.config import DialectBaud
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.rotctld.listening import listen
from birdcage.rotctld.options import options_from
from birdcage.rotctld.recogniser import Recogniser
from birdcage.rotctld.server import RotctldService
from birdcage.station.build import open_session
from birdcage.station.control_client import owners_folder
from birdcage.station.control_server import ControlServer
from birdcage.station.inhibitor import SleepInhibitor

LOOK_S = 0.2
"""How often it is looked whether the station still runs."""


class RotctldServer:
    """Serves an antenna to Gpredict and others. A station takes the antenna over until `serve_forever` returns.

    It obeys HELD and the limits of `birdcage.toml`, and `birdcage stop` reaches it. An antenna with `leapfrog_enabled`
    gets the published overshoot for streams of targets: `docs/network.md` tells what that costs.
    """

    def __init__(self, antenna: BirdcageAntenna, host: str = "127.0.0.1", port: int = 4533) -> None:
        """Listen from now on; port 0 is any free one. ConfigError where that can't be done."""
        self._paths = Paths.default()
        flags = {"rotctld.host": host, "rotctld.port": port}
        self._settings = load(self._paths.config_file, flags=flags)
        self._listener = listen(host, port)
        config = antenna.config
        self._session = open_session(
            port=config.port, firmware=antenna.rotator.facts.firmware, settings=self._settings, paths=self._paths,
            baud=None if isinstance(config.baudrate, DialectBaud) else config.baudrate, clock=RealClock(),
            antenna=antenna,
        )  # fmt: skip
        station = self._session.station
        options = replace(options_from(self._settings), leapfrog=config.leapfrog_enabled)
        recogniser = Recogniser(
            self._session.clock, self._paths, lambda: load(self._paths.config_file, flags=flags),
            on=self._settings.rotctld.recognise and not options.leapfrog,  # that is promised for streams
        )  # fmt: skip
        self._service = RotctldService(
            station, self._listener, self._settings.rotctld, options, show=station.show_network, recogniser=recogniser
        )

    @property
    def address(self) -> tuple[str, int]:
        """Where it listens."""
        return self._service.address

    def serve_forever(self) -> None:
        """Drive the dish and serve clients on this thread until `shutdown`. In the end STOP, if the dish moves.

        Raises what ended the station, if that failed.
        """
        with ExitStack() as stack:
            stack.callback(self._session.close)
            stack.callback(self._service.shutdown)
            station = self._session.station
            stack.callback(ControlServer(station, owners_folder(self._paths)).close)
            stack.callback(SleepInhibitor(station).close)
            self._session.start()
            self._service.start()
            while not self._service.wait(LOOK_S) and self._session.crash is None:
                pass
        for crash in (self._session.crash, self._service.crash):
            if crash is not None:
                raise crash

    def shutdown(self) -> None:
        """End `serve_forever`, and wait until its clients are hung up on. Any thread."""
        self._service.shutdown()
