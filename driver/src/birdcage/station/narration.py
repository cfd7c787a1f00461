"""What the station decides and learns, as log records: for `-v`, `-vv` and `--log`."""

from __future__ import annotations

import logging

from birdcage.link.transcript import Transcript
from birdcage.link.transcript_line import TranscriptEntry
from birdcage.station.events import (
    ActivityChanged,
    ClientIgnored,
    DishRestarted,
    Event,
    FaultAcknowledged,
    FaultRaised,
    HeldChanged,
    LeaseChanged,
    LinkChanged,
    MoveEnded,
    MoveStarted,
    NotNowChanged,
    PositionRead,
    PursuitChanged,
    ReadingRead,
    Recovered,
    SettingsSaved,
    StopConfirmed,
    StopSent,
    TaskChanged,
)
from birdcage.station.state import Pointing
from birdcage.station.station import Station

log = logging.getLogger("birdcage.station")
wire = logging.getLogger("birdcage.wire")


def narrate(station: Station, transcript: Transcript) -> None:
    """Log every event of the station as INFO, readings and each chunk on the wire as DEBUG."""
    station.subscribe(_hear)
    transcript.listen(_pass_on)


def _pass_on(entry: TranscriptEntry) -> None:
    if wire.isEnabledFor(logging.DEBUG):
        wire.debug("%s %s", entry.direction, entry.text)


def _hear(event: Event) -> None:
    reading = isinstance(event, PositionRead | ReadingRead)
    level = logging.DEBUG if reading else logging.INFO
    if log.isEnabledFor(level) and (words := words_of(event)):
        log.log(level, "%s", words)


def words_of(event: Event) -> str:
    """Return an event in one line; empty for those that only repeat others in passing."""
    match event:
        case LinkChanged(link=link):
            return f"link {link.state.value}" + (f": {link.detail}" if link.detail else "")
        case PositionRead(position=position):
            return f"position {_direction(position)}" + (" (modelled)" if position.modelled else "")
        case ReadingRead():
            return f"read {event.feature} = {event.value} {event.unit}".rstrip()
        case MoveStarted(motion=motion):
            aim = (f"AZ {motion.to_az_deg:.2f} EL {motion.to_el_deg:.2f}" if motion.to_skew_deg is None
                   else f"skew {motion.to_skew_deg:.2f}")  # fmt: skip
            time = f"{motion.eta - motion.started:.1f} s" if motion.eta_known else "time unknown"
            return f"{event.holder} moves it to {aim}, {time}; STOP by {motion.stop_means}"
        case MoveEnded(position=position):
            where = "" if position is None else f" at {_direction(position)}"
            return f"move {event.end.value}: {event.reason}{where}"
        case StopSent(report=report):
            return f"STOP by {report.by}: {report.means}. {report.sentence}"
        case StopConfirmed(report=report):
            sure = {True: "confirmed", False: "NOT confirmed", None: "neither confirmed nor not"}[report.confirmed]
            return f"STOP {sure}. {report.sentence}"
        case HeldChanged(held=held):
            return "released" if held is None else f"held by {held.by} ({held.why})"
        case LeaseChanged():
            return f"control: {event.holder or 'free'}, before {event.previous or 'free'}"
        case FaultRaised(fault=fault):
            return f"fault {fault.reason}: {fault.what} {fault.meaning}"
        case FaultAcknowledged():
            return f"fault {event.fault.reason} acknowledged by {event.by}"
        case ActivityChanged():
            return f"activity: {event.activity.value} {event.text}".rstrip()
        case TaskChanged(task=task) if task.kind != "pursuit":
            how_far = "" if task.of is None else f" {task.done} of {task.of}"
            return f"{task.kind} by {task.holder}: {task.phase.value}{how_far} {task.why}".rstrip()
        case ClientIgnored():
            return f"{event.client} is ignored: {event.why}"
        case DishRestarted():
            return f"the dish has started: {event.said}"
        case SettingsSaved(names=names):
            return f"the dish saved {', '.join(names) or 'its settings'}"
        case Recovered(sentence=sentence):
            return sentence
        case NotNowChanged(sentence=sentence):
            return sentence or "the dish may move unattended again"
        case PursuitChanged(pursuit=pursuit):
            return f"pursuit of {pursuit.plan.aim.name}: {pursuit.phase.value} {pursuit.why}".rstrip()
    return ""


def _direction(position: Pointing) -> str:
    return f"AZ {position.az_deg:.2f} EL {position.el_deg:.2f}"
