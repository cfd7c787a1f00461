"""What a station needs, one thing each: is it good, is it worth a look, must it be mended first."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.ready.check import Check

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths


def checks(paths: Paths, settings: Settings, now: datetime, *, try_recording: bool = False) -> Iterator[Check]:
    """Yield every check, in the order in which one mends them; takes at most 10 s.

    No port is opened. Over a network the receiver is asked, where one is set, and what the feed is heard by:
    `try_recording` lets the receiver record for 2 s more.
    """
    from birdcage.ready.radio import radio
    from birdcage.ready.signal import signal
    from birdcage.ready.sky import clock

    for check in kept_checks(paths, settings, now):
        yield check
        if check.subject == "place":
            yield clock(paths, now)
        if check.subject == "downlinks":
            yield from radio(settings, try_recording=try_recording)
            yield from signal(settings)


def kept_checks(paths: Paths, settings: Settings, now: datetime) -> Iterator[Check]:
    """Yield what files tell: nothing is asked, neither the system about its clock nor a receiver.

    For a running app: it watches its clock itself, and some receivers serve one program at a time: its tracker.
    """
    from birdcage.ready.sky import elements, ephemeris

    yield config(paths, settings)
    yield place(settings)
    yield from elements(paths, now)
    yield ephemeris(now)
    yield dish(settings)
    yield port(settings)
    yield tv_search(settings)
    yield limits(settings)
    yield feed(settings)
    yield downlinks(paths)
    yield from hooks(settings)


def config(paths: Paths, settings: Settings) -> Check:
    """Whether birdcage.toml could be read."""
    if not settings.problems:
        there = paths.config_file.exists()
        return Check(
            "config",
            "config",
            "good",
            f"{paths.config_file} is in order" if there else "no file: every setting has its default",
        )
    count = len(settings.problems)
    words = f"{settings.problems[0].text}{f' And {count - 1} more.' if count > 1 else ''}"
    if settings.motion_problem is not None:
        return Check("config", "config", "must", f"nothing would move: {words}", "birdcage config check")
    return Check("config", "config", "look", words, "birdcage config check")


def place(settings: Settings) -> Check:
    """Whether it is known where the dish will stand."""
    here = settings.place
    if here.latitude_deg is None or here.longitude_deg is None:
        return Check(
            "place", "place", "must", "not set, so passes and directions can't be computed", "birdcage place add"
        )
    where = f"{here.latitude_deg:.3f}, {here.longitude_deg:.3f}, {here.height_m:.0f} m"
    from birdcage.sky.horizon import horizon_words

    horizon = horizon_words(here.horizon)
    return Check("place", "place", "good", f"{f'{here.name}: ' if here.name else ''}{where}, {horizon}")


def dish(settings: Settings) -> Check:
    """Whether it is known which dish it is."""
    from birdcage.station.known import model_of, wrong_facts

    name = settings.dish.firmware
    if name is None:
        return Check("dish", "dish", "look", "firmware not set: the port is asked", "birdcage setup")
    model = model_of(name)
    if model is None:
        return Check("dish", "dish", "must", f"firmware {name!r} is unknown to this version", "birdcage setup")
    for sentence in wrong_facts(name, settings):
        return Check("dish", "dish", "must", sentence, "birdcage config path")
    return Check("dish", "dish", "good", f"{model.name}, firmware {name}")


def port(settings: Settings) -> Check:
    """Whether the port is ready to use. It is not opened."""
    name = settings.dish.port
    if name is None:
        return Check("port", "port", "look", "not set; plug in the adapter", "birdcage ports")
    if ":" in name and not Path(name).exists():
        return Check("port", "port", "look", f"{name} is an address; it is tried only when opened")
    if name.upper().startswith("COM"):
        from birdcage.station.known import list_ports

        plugged = name.upper() in (each.device.upper() for each in list_ports())
        return Check("port", "port", "good", f"{name} is there") if plugged else _no_port(name)
    if not Path(name).exists():
        return _no_port(name)
    if not os.access(name, os.R_OK | os.W_OK):
        return Check(
            "port",
            "port",
            "must",
            f"{name} is there, but you may not open it",
            "birdcage wiring, and the group dialout",
        )
    return Check("port", "port", "good", f"{name} is ready to use")


def _no_port(name: str) -> Check:
    return Check("port", "port", "look", f"{name} is not plugged in. Pack the adapter", "birdcage ports")


def tv_search(settings: Settings) -> Check:
    """Whether the dish's own search for television is remembered as switched off."""
    from birdcage.station.known import SearchSwitch, model_of

    model = model_of(settings.dish.firmware, settings)
    if model is not None and model.search_switch is SearchSwitch.NEVER_SEARCHES:
        return Check("search", "TV search", "good", "this dish has none")
    kept = settings.setup.kept("search")
    if kept is not None and kept.done:
        return Check("search", "TV search", "good", f"{kept.evidence or 'done'} ({kept.when[:10]})")
    words = "left out" if kept is not None and kept.skipped else "not known"
    return Check("search", "TV search", "look", f"{words}: the dish may begin to search by itself", "birdcage init")


def limits(settings: Settings) -> Check:
    """Whether the user said how far the cable and the elevation may go."""
    motion = settings.motion
    told = []
    if None not in (motion.cable_min_deg, motion.cable_max_deg):
        told.append(f"cable {motion.cable_min_deg:+.0f}° to {motion.cable_max_deg:+.0f}°")
    if motion.min_elevation_deg is not None or motion.max_elevation_deg is not None:
        ends = ("-" if each is None else f"{each:g}°" for each in (motion.min_elevation_deg, motion.max_elevation_deg))
        told.append("elevation {} to {}".format(*ends))
    if motion.no_go_sectors:
        told.append(f"{len(motion.no_go_sectors)} no-go sectors")
    if motion.cable_min_deg is None or motion.cable_max_deg is None:
        told.insert(0, "only the firmware's cable limits: your own coax may be shorter")
        return Check("limits", "limits", "look", ", ".join(told), "birdcage setup")
    return Check("limits", "limits", "good", ", ".join(told))


def feed(settings: Settings) -> Check:
    """Whether the settings say which feed is fitted."""
    from birdcage.base.beam import beam_of
    from birdcage.base.config import feed_label
    from birdcage.sky.downlinks_hearing import has_band
    from birdcage.station.known import model_of

    name, mounted = settings.feed.active, settings.active_feed
    label = feed_label(name)
    if "feed.active" not in settings.sources:
        return Check("feed", "feed", "look", f"{label}, the default: is this feed mounted?", "birdcage setup")
    if not has_band(mounted):
        return Check("feed", "feed", "look", f"{name} has no band: freq_min_hz and freq_max_hz", "birdcage config path")
    assert mounted.freq_min_hz is not None
    assert mounted.freq_max_hz is not None
    lo = "" if mounted.lo_hz is None else f", LO {mounted.lo_hz / 1e6:.10g} MHz"
    band = f"{mounted.freq_min_hz / 1e6:.10g} to {mounted.freq_max_hz / 1e6:.10g} MHz"
    stow = "may be stowed" if mounted.stow_allowed else "stow locked"
    model = model_of(settings.dish.firmware)
    beam = beam_of(mounted, None if model is None else model.reflector)
    width = "" if beam is None else f", beam {beam.size}"
    return Check("feed", "feed", "good", f"{label}, {band}{lo}{width}, {stow}")


def downlinks(paths: Paths) -> Check:
    """Whether the user's own table of downlinks could be read."""
    from birdcage.sky.downlinks_read import load_downlinks

    table = load_downlinks(paths.downlinks_file)
    if table.problems:
        return Check("downlinks", "downlinks", "look", table.problems[0], f"mend {paths.downlinks_file}")
    own = sum(each.own for each in table)
    return Check("downlinks", "downlinks", "good", f"{len(table)} known{f', {own} of them your own' if own else ''}")


def hooks(settings: Settings) -> Iterator[Check]:
    """Whether the commands that are set can be found. None is run."""
    import shlex
    import shutil

    commands = {
        key: command
        for key in ("at_reach_start", "at_tca", "at_reach_end", "on_event")
        if (command := getattr(settings.hooks, key)) is not None
    }
    for key, command in commands.items():
        try:
            words = shlex.split(command)
        except ValueError as error:
            yield Check("hooks", "hooks", "look", f"{key} cannot be read: {error}", "birdcage config path")
            return
        if not words or shutil.which(words[0]) is None:
            missing = f"there is no program {words[0]!r}" if words else "it is empty"
            yield Check("hooks", "hooks", "look", f"{key}: {missing}", "birdcage config path")
            return
    if commands:
        yield Check("hooks", "hooks", "good", f"{', '.join(commands)} can be started")
