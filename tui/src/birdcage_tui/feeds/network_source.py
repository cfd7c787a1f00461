"""The server for Gpredict and others, which the app runs over its own station."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from birdcage.base.errors import ConfigError

if TYPE_CHECKING:
    from birdcage.base.clock import Clock
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.rotctld.server import RotctldService
    from birdcage.station.station import Station

WARNING = "network"
"""The subject under which the station warns that other machines reach the dish."""


class NetworkSource(Protocol):
    """Runs the server, or not. All of it on the app's thread."""

    @property
    def is_on(self) -> bool:
        """Whether it serves."""

    def switch(self) -> str:
        """Start the server, or stop it; return what has been done, or why not, as a sentence."""

    def hang_up(self, number: int) -> None:
        """End the connection of a client (`NetworkClient.number`)."""

    def shut_out(self, number: int, *, on: bool) -> None:
        """Ignore the wishes of a client, and end what it moves; or take them again."""

    def recognise(self, *, on: bool) -> None:
        """Recognise which satellites clients follow, or go by their own steps."""

    def close(self) -> None:
        """Hang up on everybody, and stop."""


class StationNetwork(NetworkSource):
    """Serves the clients of the app's station, as `[rotctld]` of the settings says."""

    def __init__(self, station: Station, clock: Clock, paths: Paths, load: Callable[[], Settings]) -> None:
        """`load` reads the settings again at each start of the server, and as satellites are recognised."""
        self._station, self._clock, self._paths, self._load = station, clock, paths, load
        self._service: RotctldService | None = None

    @property
    def is_on(self) -> bool:
        """Whether it serves; one that a fault has ended does not."""
        return self._service is not None and self._service.crash is None

    def switch(self) -> str:
        """Start the server, or stop it."""
        if self.is_on:
            self.close()
            return "The server has stopped. Programs can't reach the dish."
        from birdcage.rotctld.listening import listen, wide_warning
        from birdcage.rotctld.options import options_from
        from birdcage.rotctld.recogniser import Recogniser
        from birdcage.rotctld.server import RotctldService

        self.close()
        try:
            settings = self._load()
            own = settings.rotctld
            listener = listen(own.host, own.port)
        except ConfigError as error:
            self._station.warn(WARNING, str(error))
            return str(error)
        station = self._station
        recogniser = Recogniser(self._clock, self._paths, self._load, on=own.recognise)
        service = RotctldService(
            station, listener, own, options_from(settings), show=station.show_network, recogniser=recogniser
        )
        self._service = service
        host, port = service.address
        warning = wide_warning(host, port, own.networks, read_only=own.read_only)
        station.warn(WARNING, warning)
        service.start()
        return warning or f"Programs reach the dish at {host} port {port}."

    def hang_up(self, number: int) -> None:
        """End the connection of a client."""
        if self._service is not None:
            self._service.hang_up(number)

    def shut_out(self, number: int, *, on: bool) -> None:
        """Ignore the wishes of a client, or take them again."""
        if self._service is not None:
            self._service.shut_out(number, on=on)

    def recognise(self, *, on: bool) -> None:
        """Recognise which satellites clients follow, or not."""
        if self._service is not None:
            self._service.recognise(on=on)

    def close(self) -> None:
        """Hang up on everybody, and stop."""
        service, self._service = self._service, None
        if service is not None:
            service.shutdown()
            self._station.show_network(None)
            self._station.warn(WARNING, "")
