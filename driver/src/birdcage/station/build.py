"""Builds a session from the settings: the one place where the parts are put together."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from functools import partial
from types import MappingProxyType

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import Clock
from birdcage.base.config import Settings
from birdcage.base.journal import Journal
from birdcage.base.paths import Paths
from birdcage.base.version import version
from birdcage.base.wear import WearBook
from birdcage.link.identity import dish_identity
from birdcage.link.link import Link
from birdcage.link.opening import open_link
from birdcage.link.ports import PortLister, find_again, identify, list_ports
from birdcage.link.transcript import Transcript
from birdcage.station.event_hooks import EventHooks
from birdcage.station.held_keeper import HeldKeeper
from birdcage.station.narration import narrate
from birdcage.station.not_now import NotNow
from birdcage.station.record import keep_journal
from birdcage.station.session import Session
from birdcage.station.settings import SettingsFile, StationSettings, rules_from, site_from
from birdcage.station.station import Station
from birdcage.station.task import Task
from birdcage.station.wear import keep_wear

CLOSE_S = 0.2
"""How long leaving may wait for the journal and the transcript to reach the disk."""


def open_session(
    *,
    port: str,
    firmware: str,
    baud: int | None,
    settings: Settings,
    paths: Paths,
    clock: Clock,
    survey: bool = True,
    reconnect: bool = True,
    ports: PortLister = list_ports,
    identify: Callable[[str], str | None] | None = None,
    antenna: BirdcageAntenna | None = None,
    load: Callable[[], Settings] | None = None,
    tasks: Mapping[str, Callable[..., Task]] = MappingProxyType({}),
    on_close: Callable[[], None] = lambda: None,
) -> Session:
    """Build a session that will speak `firmware` over `port`; nothing is opened before it is started or stepped.

    An empty `port` is none yet: the link is then lost, and nothing is looked for before `Connect` names one.
    `survey` reads identity and limits once the dish rests; `reconnect` looks for a lost port again. `identify` names
    the dish at a port for what is remembered of it, in place of the port's own identity. `antenna` is one that a script
    has made, which the station takes over. `load` reads the settings again when an attached program has changed them;
    without it that is refused. `tasks` are those that may be begun by their kinds.
    `on_close` is called once the dish has been seen to.
    KeyError for a firmware that this version does not speak.
    """
    transcript = Transcript(paths.transcripts if settings.link.transcript else None, version=version)
    journal, wear = Journal(paths.journal), WearBook(paths.journal)
    rules, own = rules_from(settings), settings.station
    identity = identify or partial(dish_identity, list_ports=ports)
    held_keeper = HeldKeeper(paths.state, identity)

    def open_port(name: str, rate: int) -> Link:
        return open_link(name, baud=rate, clock=clock, transcript=transcript)

    station_settings = StationSettings(
        port=port,
        firmware=firmware,
        baud=baud,
        open_link=open_port,
        own_facts=settings.own_facts,
        site=site_from(settings),
        find_port=_finder(port, settings.link.usb_identity, ports),
        delay_s=settings.link.delay_s,
        survey=survey,
        reconnect=reconnect,
        backup_folder=paths.backups,
        state_folder=paths.state,
        identify=identity,
        held_keeper=held_keeper,
        **{each.name: getattr(rules, each.name) for each in fields(rules)},
        not_now=None if own.not_now is None else NotNow(own.not_now, own.not_now_every_s, _shelter(settings)),
        tasks=tasks,
        home_after_reboot=own.after_reboot == "home",
        file=None if load is None else SettingsFile(paths.config_file, load),
        remark=lambda text: transcript.remark(text, clock.utc()),
    )
    station = Station(clock, station_settings) if antenna is None else Station.adopt(antenna, clock, station_settings)
    narrate(station, transcript)
    replies = keep_journal(station, journal, lambda name: identity(name) or name)
    tally = keep_wear(station, wear)
    hooks = settings.hooks
    event_hooks = None if hooks.on_event is None else EventHooks(station, hooks.on_event, hooks.deadline_s)

    def close() -> None:
        on_close()
        if event_hooks is not None:
            event_hooks.close(CLOSE_S)
        held_keeper.close(CLOSE_S)
        tally.write()
        replies.write()
        wear.close(CLOSE_S)
        journal.close(CLOSE_S)
        transcript.close(CLOSE_S)

    return Session(clock, station, on_close=close, wire=transcript)


def _shelter(settings: Settings) -> tuple[float, float] | None:
    """Return where the dish goes when the owner's command says *not now*: the park position, if it is to park then."""
    az_deg, el_deg = settings.tracking.park_az_deg, settings.tracking.park_el_deg
    if settings.station.not_now_then != "park" or az_deg is None or el_deg is None:
        return None
    return az_deg, el_deg


def _finder(first: str, identity: str | None, ports: PortLister) -> Callable[[str], str | None]:
    """Return what finds a port: where it was, or where the adapter with the same USB identity is now.

    The identity is the configured one, of the port that was asked for `first`, or the one that the port had when it
    was last seen.
    """
    seen = {first: identity}

    def find(port: str) -> str | None:
        here = identify(port, ports)
        known = seen.get(port)
        if known is None:
            known = seen[port] = here
        # Another adapter may have taken the path since: it is not this dish's.
        return port if here == known else find_again(known or "", ports)

    return find
