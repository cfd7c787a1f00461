"""Commands of the Network tab: the server for Gpredict and others, and its clients."""

from __future__ import annotations

from birdcage_tui.commands.table import Command, Reason, always
from birdcage_tui.shown.allowed import CommandContext

PAGE, HERE = "control", ("network",)
TAKE_MIN = 15
"""How many minutes of control one key takes."""


def can_choose(context: CommandContext) -> str | None:
    """Return why no client can be chosen."""
    network = context.state.network
    if network is None:
        return "The server is off. o starts it."
    return None if network.clients else "No program is connected."


def can_recognise(context: CommandContext) -> str | None:
    """Return why satellites can't be recognised."""
    return "The server is off. o starts it." if context.state.network is None else None


def can_take(context: CommandContext) -> str | None:
    """Return why control can't be taken now."""
    if context.state.held is not None:
        return "STOP is latched. Enter releases it."
    return None if context.state.fault is None else "A fault waits. Enter acknowledges it."


def _network(
    name: str, keys: tuple[str, ...], shown: str, title: str, text: str, refused: Reason, footer: str = ""
) -> Command:
    return Command(f"network-{name}", keys, shown, title, text, "Network", refused, footer, HERE, page=PAGE)


NETWORK = (
    _network("serve", ("o",), "o", "Server on, off", "Start or stop the server for Gpredict, SatNOGS and others.",
             always, "server"),
    _network("take", ("t",), "t", f"Control, {TAKE_MIN} min",
             f"Take control for {TAKE_MIN} minutes. It is given back by itself.", can_take, f"take {TAKE_MIN} min"),
    _network("give", ("B",), "B", "Give back", "Give control back now.", always, "give back"),
    _network("up", ("up", "k"), "↑ k", "Client above", "In the list of clients.", can_choose),
    _network("down", ("down", "j"), "↓ j", "Client below", "In the list of clients.", can_choose),
    _network("ignore", ("i",), "i", "Ignore", "Ignore the wishes of the chosen client, or take them again.",
             can_choose, "ignore"),
    _network("recognise", ("r",), "r", "Recognise", "Follow what clients follow by a plan, or by their own steps.",
             can_recognise, "recognise"),
    _network("hang-up", ("x",), "x", "Hang up", "End the connection of the chosen client.", can_choose, "hang up"),
)  # fmt: skip
