"""Who is connected to the server, what each wants and gets; what one of them said; how to connect."""

from __future__ import annotations

from datetime import datetime

from birdcage.station.network_state import NetworkClient, NetworkRole, NetworkState

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.shown.track_words import plain_name
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

Column = tuple[str, int]
COLUMNS: tuple[Column, ...] = (("program", 17), ("from", 22), ("wants", 14), ("last", 15), ("errors", 8), ("state", 0))
NARROW: tuple[Column, ...] = (("program", 15), ("wants", 14), ("last", 13), ("state", 0))
WIDE = 110
"""Columns from which each client has all that is known of it."""
ROLES = {NetworkRole.CONTROL: "accent", NetworkRole.IGNORED: "warn", NetworkRole.WATCHES: "dim"}
SERVED = "Programs may connect at {address}. No program is connected yet."


def client_words(client: NetworkClient, now: datetime, *, strict: bool) -> dict[str, str]:
    """Return what the columns say of a client."""
    wants = "-"
    if client.wants_az_deg is not None and client.wants_el_deg is not None:
        wants = f"{client.wants_az_deg:.1f}/{client.wants_el_deg:.1f}"
    last = "-"
    if client.last_utc is not None:
        last = f"{client.last_command.split(' ')[0][:6]} {max((now - client.last_utc).total_seconds(), 0.0):.1f} s"
    return {
        "program": client.program.value or client.name, "from": client.address, "wants": wants, "last": last,
        "errors": str(client.errors), "state": state_words(client, strict=strict),
    }  # fmt: skip


def state_words(client: NetworkClient, *, strict: bool) -> str:
    """Return what becomes of its wishes."""
    if client.stale:
        return "is told the last position: no link"
    if client.shut_out:
        return f"ignored by a person, told RPRT {-9 if strict else 0}. i ends that"
    if client.role is NetworkRole.CONTROL:
        if client.waits:
            return "control, waits for the link"
        if client.follows:
            return f"control, follows {plain_name(client.follows)}"
        if client.lead_s is None:
            return "control"
        return "control, smoothed" + (f", {client.lead_s:.1f} s ahead" if client.lead_s > 0.0 else " on trial")
    if client.role is NetworkRole.IGNORED:
        return f"ignored {client.ignored} times, told RPRT {-9 if strict else 0}"
    return "watches"


class ClientsPane(Pane):
    """A row for each client; the chosen one has the cursor."""

    HELP = "Programs that are connected to the server, and what becomes of their wishes."
    chosen: int | None = None
    """The number of the client under the cursor."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Programs"

    def client(self, network: NetworkState | None) -> NetworkClient | None:
        """Return the one under the cursor; the first where that has left."""
        clients = () if network is None else network.clients
        return next((each for each in clients if each.number == self.chosen), clients[0] if clients else None)

    def move(self, network: NetworkState | None, steps: int) -> None:
        """Put the cursor on another one."""
        here = self.client(network)
        if network is not None and here is not None:
            at = network.clients.index(here) + steps
            self.chosen = network.clients[min(max(at, 0), len(network.clients) - 1)].number

    def draw(self, cells: Cells, view: View) -> None:
        """Write the heading and as many rows as there is room for, the chosen one among them."""
        network = view.state.network
        here = self.client(network)
        if network is None or here is None:
            words = "" if network is None else SERVED.format(address=network.address)
            for y, line in enumerate(wrap(words, max(cells.width - 2, 10))):
                cells.put(1, y, line, "dim")
            return
        columns = COLUMNS if cells.width >= WIDE else NARROW
        x = 3
        for name, width in columns:
            cells.put(x, 0, name, "dim")
            x += width
        room, at = cells.height - 1, network.clients.index(here)
        first = max(0, min(at - room // 2, len(network.clients) - room))
        for y, client in enumerate(network.clients[first : first + room], 1):
            self._row(cells, y, client, columns, view, here=client is here)
        hidden = len(network.clients) - room
        if hidden > 0:
            cells.right(cells.width - 1, 0, f"{hidden} more", "dim")

    @staticmethod
    def _row(cells: Cells, y: int, client: NetworkClient, columns: tuple[Column, ...], view: View, *, here: bool
             ) -> None:  # fmt: skip
        network = view.state.network
        words, x = client_words(client, view.utc, strict=network is not None and network.strict), 3
        cells.put(1, y, "▶" if here else " ", "accent")
        for name, width in columns:
            room = (width or cells.width - x) - 1
            ink = ROLES[client.role] if name == "state" else "strong" if here and name == "program" else "text"
            cells.put(x, y, cut(words[name], room), ink)
            x += width


class LinesPane(Pane):
    """What the chosen client has said, and what it was answered; the latest at the foot."""

    client: NetworkClient | None = None

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - `client` is of this view
        """Write the last lines."""
        if self.client is None:
            cells.put(1, 0, cut("What a program says stands here, with its answer.", cells.width - 2), "dim")
            return
        for y, line in enumerate(self.client.lines[-cells.height :]):
            x = cells.put(1, y, f"{line.utc:%H:%M:%S}.{line.utc.microsecond // 100_000}  ", "dim")
            x = cells.put(x, y, cut(line.command, max(cells.width // 2 - 8, 8)), "text")
            x = max(x + 2, cells.width // 2)
            cells.put(x, y, cut(line.reply, max(cells.width - x - 1, 1)), "dim")


class ConnectPane(Pane):
    """What to type into each program."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Connect"

    def draw(self, cells: Cells, view: View) -> None:
        """Write a line or two for each."""
        network = view.state.network
        if network is None:
            return
        host = "this machine's address" if network.host in ("0.0.0.0", "::") else network.host  # noqa: S104 - compared
        rows = (
            ("Gpredict", f"Preferences, Interfaces, Rotators: {host}, {network.port}, 0° → 180° → 360°"),
            ("SatNOGS", f"SATNOGS_ROT_MODEL=ROT_MODEL_NETROTCTL SATNOGS_ROT_PORT={host}:{network.port}"),
            ("SatDump", f"rotctl: {host}, {network.port}"),
            ("Hamlib", f"rotctl -m 2 -r {host}:{network.port}"),
        )
        y = 0
        for name, words in rows:
            cells.put(1, y, name, "dim")
            for line in wrap(words, max(cells.width - 13, 12)):
                cells.put(11, y, line, "text")
                y += 1
