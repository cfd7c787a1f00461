"""The Network tab: who has control of the dish now, who may take it, and how it is stopped from elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from birdcage.station.network_state import NetworkClient, NetworkState
from birdcage.station.requests import AcquireLease, ReleaseLease
from birdcage.station.state import StationState
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.commands.network import TAKE_MIN
from birdcage_tui.control.clients import ClientsPane, ConnectPane, LinesPane
from birdcage_tui.control.last import LogPane
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.shown.held_words import after_release
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.state_words import through
from birdcage_tui.shown.track_words import live_words, next_words, plain_name
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.pane import Pane

Row = tuple[str, str, str]
"""A name, the ink of the words after it, and the words."""

HELP = "Who controls the dish, and what else can stop or move it."
NAMES = 18
"""Columns of the names."""
BESIDE = 100
"""Columns from which what the last commands did stands beside it."""
LOG, FAR = 46, 200
"""Columns of that, and from which it has half of the width."""
OVER, LEAST_SKY = 24, 16
"""Rows of the words where the sky stands under them, and what that has then at least."""
MOVERS: tuple[Row, ...] = (
    ("You", "text", "arrows, g, presets, when control is free or the tracker's."),
    ("Tracker", "text", "f, autotrack on Track, while control is free or its own."),
    ("Console", "text", "raw lines (page 5), without limits. It asks first."),
    ("Other programs", "text", "kept out, except root and any that had the port open."),
)
SHELL: tuple[Row, ...] = (
    ("birdcage stop", "text", "stops it, whatever program drives it. It is HELD then."),
    ("birdcage hold", "text", "the same, before you work on the dish."),
    ("birdcage release", "text", "releases it, and names who waits to move it."),
)
NOT_DEMO = "These commands don't reach a demo."
OFF = "off. o serves Gpredict, SatNOGS, SatDump and others."


def now_rows(view: View) -> list[Row]:
    """Return who has control, what for, and what holds the dish."""
    state, pursuit = view.state, pursuit_of(view.state)
    holder = state.holder
    control = "free" if holder is None else f"{holder}, at this terminal" if holder == YOU else _named(state, holder)
    if state.holder_until is not None:
        control += f", until {state.holder_until:%H:%M:%S}Z"
    found = [("Control", "strong" if holder else "dim", f"{control[:1].upper()}{control[1:]}.")]
    held = state.held
    if held is not None:
        since = "" if held.utc is None else f" since {held.utc:%H:%M:%S}Z"
        ignored = f" Refused {held.next_holder} {held.ignored} times." if held.next_holder and held.ignored else ""
        by = held.by or "unknown"
        found.append(("Held", "warn", f"by {by}{since}.{ignored} Enter releases it: {after_release(view)}."))
    if pursuit is not None:
        told = "  ".join(filter(None, (plain_name(pursuit.plan.aim.name), live_words(view))))
        found.append(("Following", "text", f"{told}, for {_named(state, pursuit.holder)}."))
        if coming := next_words(view):
            found.append(("", "dim", f"{coming[:1].upper()}{coming[1:]}."))
    if state.not_now:
        found.append(("Unattended", "warn", state.not_now))
    if state.network is not None:
        found.append(("Server", "text", _served(state.network, view)))
        found += [("Recognised", "text", _followed(client)) for client in state.network.clients if client.follows]
        if not any(client.follows for client in state.network.clients):
            found.append(("Satellites", "dim", _recognises(state.network, view)))
    found.append(("Port", "text", through(state.port.split("?")[0] or "--", view)))
    return found


def _followed(client: NetworkClient) -> str:
    """Return which satellite a client follows, how well the dish does, and how well it would by the client's steps."""
    error = "" if client.follow_error_deg is None else f": {client.follow_error_deg:.2f}°"
    steps = client.steps_error_deg
    would = "" if steps is None else f"; its own steps would leave {steps:.2f}°"
    return f"{client.program or client.name} follows {plain_name(client.follows)}{error}{would}."


def _recognises(network: NetworkState, view: View) -> str:
    """Return whether satellites are recognised that clients follow, or why not."""
    own = not network.by and not view.via
    if network.recognises_why_not:
        return f"not recognised: {network.recognises_why_not}."
    if network.recognises:
        return "recognised by what programs ask for." + " r goes by their own steps." * own
    return "not recognised: programs' own steps count." + " r changes that." * own


def _named(state: StationState, holder: str) -> str:
    """Return a holder by its program, where it is a client of the server."""
    clients = () if state.network is None else state.network.clients
    return next((client.label for client in clients if client.name == holder), holder)


def _elsewhere(view: View) -> str:
    """Return why this app runs no server, and what does."""
    if not view.via:
        return "No server can be run here."
    return f"{view.via} drives the dish. `birdcage serve` in another terminal serves programs through it."


def _served(network: NetworkState, view: View) -> str:
    rules = ["read only"] * network.read_only + ["strict"] * network.strict
    away = f"turned away {network.turned_away}" if network.turned_away else ""
    by = f"run by {network.by}" if network.by else ""
    advice = "" if by or view.via else " o stops it."
    return ", ".join(filter(None, (f"on at {network.address}", by, *rules, away))) + f".{advice}"


class ControlPane(Pane):
    """Words in two columns: what is now, who may move it, and what a shell can do."""

    HELP = HELP

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Who may move the dish"

    def rows(self, view: View, width: int) -> list[Row]:
        """Return what is now, which is all that there is room for beside a server."""
        return _lines("", now_rows(view), width)

    def draw(self, cells: Cells, view: View) -> None:
        """Write group after group; where they do not all fit without, there is no air between them."""
        shell = (*SHELL, ("", "dim", NOT_DEMO)) if view.state.demo else SHELL
        now = self.rows(view, cells.width)
        groups: tuple[list[Row], ...] = (now,)
        if view.state.network is None:
            groups = (
                now, _lines("Who may move it", MOVERS, cells.width), _lines("In a shell", shell, cells.width),
                _lines("", (("Server", "dim", _elsewhere(view) if view.via else OFF),), cells.width),
            )  # fmt: skip
        air = sum(map(len, groups)) + len(groups) - 1 <= cells.height
        y = 0
        for lines in groups:
            for name, ink, words in lines:
                cells.put(1, y, name, "dim")
                cells.put(1 + NAMES, y, words, ink)
                y += 1
            y += air


def _lines(heading: str, rows: Sequence[Row], width: int) -> list[Row]:
    """Return a group with its heading, wrapped beside the names."""
    found: list[Row] = [(heading, "text", "")] if heading else []
    for name, ink, words in rows:
        lines = wrap(words, max(width - NAMES - 2, 10))
        found += [(name if not index else "", ink, line) for index, line in enumerate(lines)]
    return found


class NetworkPane(Vertical):
    """Who may move the dish. With a server: who is connected, what one of them says, and how to connect.

    Without one, where there is room: what the commands did, what comes next, and where the dish points.
    """

    HELP = HELP
    DEFAULT_CSS = f"""
    NetworkPane Pane {{ border: round $line; border-title-color: $dim; border-title-style: none;
        border-subtitle-color: $dim; }}
    NetworkPane #network-upper {{ height: 1fr; }}
    NetworkPane #network-words {{ width: 1fr; }}
    NetworkPane ControlPane {{ padding: 1 0 0 0; height: 1fr; }}
    NetworkPane LogPane {{ width: 1fr; display: none; }}
    NetworkPane SkyPane {{ display: none; height: 1fr; }}
    NetworkPane.-beside LogPane {{ display: block; width: {LOG}; }}
    NetworkPane.-far LogPane {{ width: 1fr; }}
    NetworkPane.-over ControlPane {{ height: {OVER}; }}
    NetworkPane.-over SkyPane {{ display: block; }}
    NetworkPane ClientsPane, NetworkPane #network-lower {{ display: none; }}
    NetworkPane.-serving #network-upper {{ height: auto; }}
    NetworkPane.-serving #network-words {{ height: auto; }}
    NetworkPane.-serving ControlPane {{ padding: 0; }}
    NetworkPane.-serving LogPane, NetworkPane.-serving SkyPane {{ display: none; }}
    NetworkPane.-serving ClientsPane, NetworkPane.-serving #network-lower {{ display: block; height: 1fr; }}
    NetworkPane LinesPane, NetworkPane #network-right {{ width: 1fr; height: 1fr; }}
    NetworkPane ConnectPane {{ height: 1fr; }}
    NetworkPane #network-right {{ display: none; }}
    NetworkPane.-beside #network-right {{ display: block; }}
    NetworkPane.-over ConnectPane {{ height: 8; }}
    NetworkPane.-serving.-over #network-sky {{ display: block; }}
    """

    def compose(self) -> ComposeResult:
        """All parts; which of them are seen depends on whether a server runs, and on the room."""
        with Horizontal(id="network-upper"):
            with Vertical(id="network-words"):
                yield ControlPane()
                yield SkyPane()
            yield LogPane()
        yield ClientsPane()
        with Horizontal(id="network-lower"):
            yield LinesPane()
            with Vertical(id="network-right"):
                yield ConnectPane()
                yield SkyPane(id="network-sky")

    def on_resize(self) -> None:
        """Show what has room."""
        self.set_class(self.size.width >= BESIDE, "-beside")
        self.set_class(self.size.width >= FAR, "-far")
        self.set_class(self.size.height >= OVER + LEAST_SKY, "-over")

    def show(self, view: View) -> None:
        """Draw what is seen."""
        network = view.state.network
        self.set_class(network is not None, "-serving")
        clients, lines = self.query_one(ClientsPane), self.query_one(LinesPane)
        if network is not None:
            words = self.query_one(ControlPane)
            words.styles.height = 2 + len(words.rows(view, max(self.size.width - 2, 20)))
            room = len(network.clients) + 3
            clients.styles.height = min(max(room, 4), max(self.size.height // 3, 4))
            lines.client = clients.client(network)
            said = "" if lines.client is None else f" of {lines.client.label}"
            lines.border_title = f"Lines{said}"
        else:
            self.query_one(ControlPane).styles.height = None
        for pane in self.query(Pane):
            if pane.display:
                pane.show(view)

    @property
    def _app(self) -> AppHost:
        return cast(AppHost, self.app)

    def do(self, command: str) -> bool:
        """Carry out a command of this tab."""
        host, clients = self._app, self.query_one(ClientsPane)
        state = host.view().state
        match command:
            case "network-serve":
                host.say(_elsewhere(host.view()) if host.network is None else host.network.switch())
            case "network-take":
                host.ask(AcquireLease(YOU, take_over=True, for_s=TAKE_MIN * 60.0))
                host.say(f"You have control for {TAKE_MIN} minutes.")
            case "network-give":
                host.ask(ReleaseLease(YOU))
            case "network-up" | "network-down":
                clients.move(state.network, 1 if command == "network-down" else -1)
            case "network-hang-up" | "network-ignore" | "network-recognise":
                host.say(self._with_server(command, host, state.network, clients.client(state.network)))
            case _:
                return False
        host.paint()
        return True

    @staticmethod
    def _with_server(command: str, host: AppHost, network: NetworkState | None, chosen: NetworkClient | None) -> str:
        """Do what only the program does that runs the server; return what was done, or why not."""
        server = host.network
        if server is None or network is None:
            return _elsewhere(host.view())
        if network.by:
            return f"{network.by} runs that server. Only that program changes it."
        if command == "network-recognise":
            server.recognise(on=not network.recognises)
            return ("Programs' own steps count. No satellite is recognised." if network.recognises
                    else "Satellites that programs follow are recognised.")  # fmt: skip
        if chosen is None:
            return "No program is connected."
        if command == "network-hang-up":
            server.hang_up(chosen.number)
            return f"Hung up on {chosen.label}. It may connect again."
        server.shut_out(chosen.number, on=not chosen.shut_out)
        return (f"{chosen.label} may move the dish again." if chosen.shut_out
                else f"Wishes of {chosen.label} are ignored from now on.")  # fmt: skip
