"""Clients that come and go, in a sentence."""

from __future__ import annotations

from birdcage.rotctld.served_client import HangUp
from birdcage.rotctld.server import ClientNews

WHY = {
    HangUp.QUIT: "has left",
    HangUp.LOST: "is gone: its connection broke",
    HangUp.SLOW: "was hung up on: it did not read its answers",
    HangUp.SILENT: "was hung up on: it said nothing for too long",
    HangUp.FULL: "was not let in: as many are connected as may be ([rotctld] most_clients)",
    HangUp.NOT_ALLOWED: "was not let in: its address is in no allowed network",
    HangUp.UNWANTED: "was hung up on by hand",
    HangUp.FAULT: "was hung up on after a fault of birdcage; --log has the details",
    HangUp.CLOSING: "was hung up on: the server ends",
}


def words_of_news(news: ClientNews) -> str:
    """Return what happened to a client, for people."""
    client = news.client
    if news.why is None:
        return f"{client.name} connected from {client.address}."
    return f"{client.label}, {client.address}, {WHY[news.why]}."
