"""`birdcage serve`."""

from __future__ import annotations

import socket
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.base.config import RotctldSettings
    from birdcage.cli.station_command import StationCommand
    from birdcage.rotctld.server import ClientNews
    from birdcage.rotctld.session_recorder import SessionRecorder

NETWORK = "network"
"""The subject of the warning that other machines reach the dish."""


@click.command("serve", epilog=exits.EPILOG)
@click.option("--host", help="Address to listen on, or BIRDCAGE_LISTEN_HOST.  [default: as set, or 127.0.0.1]")
@click.option(
    "--listen-port", type=click.IntRange(0, 65_535),
    help="TCP port, or BIRDCAGE_LISTEN_PORT; 0: any free one.  [default: as set, or 4533]",
)  # fmt: skip
@click.option(
    "--allow", metavar="NET", multiple=True,
    help="Let only programs in this network connect, and those on this machine: 192.168.1.0/24; repeatable.",
)  # fmt: skip
@click.option("--read-only", is_flag=True, help="Clients read the position. They move nothing.")
@click.option("--strict", is_flag=True, help="Answer a wish that is not carried out with an error, RPRT -9.")
@click.option("--skip-init", is_flag=True, help="Do not read the dish's identity and settings at the start.")
@click.option("--record", metavar="FILE", help="Append what clients say, and what they are answered, to FILE.")
@click.option(
    "--easycomm", is_flag=True,
    help="Serve a program that knows only a serial port: EasyComm at a pseudo terminal, and no network.",
)  # fmt: skip
@click.option(
    "--link", type=click.Path(path_type=Path), help="With --easycomm: a symbolic link to it, a name that stays."
)
@click.option(
    "--selftest", is_flag=True, help="Say what the clients say to a server over this dish; tell what would fail."
)
@click.option(
    "--moves", is_flag=True, help="With --selftest: let it move the dish. A simulated one is moved in any case."
)
@click.option("--print-gpredict", is_flag=True, help="Print a .rot file for Gpredict with this dish's limits; no more.")
@click.option("--print-satnogs", is_flag=True, help="Print the variables for satnogs-client, and do nothing else.")
@click.option(
    "--print-systemd", type=click.Choice(["service", "socket"]),
    help="Print a unit for systemd that runs this, or one of the socket that starts it; no more.",
)  # fmt: skip
@global_options()
def command(
    host: str | None, listen_port: int | None, allow: tuple[str, ...], read_only: bool, strict: bool, skip_init: bool,
    record: str | None, easycomm: bool, link: Path | None, selftest: bool, moves: bool, print_gpredict: bool,
    print_satnogs: bool, print_systemd: str | None,
) -> None:  # fmt: skip
    """Drive the dish for Gpredict, SatNOGS, SatDump and other programs that speak to Hamlib's rotctld.

    It listens before the dish answers, and goes on while the cable is out. If another birdcage program has the port,
    clients reach the dish through that one. The first client that asks for a motion
    has control until it leaves. `birdcage stop` stops the dish whoever moves it. Ctrl+C ends the server, STOP first.
    A socket that systemd passes is listened on, whatever --host and --listen-port say.
    With --json, stdout has what happens in the form of docs/events.md, and a line for each client.
    """
    from birdcage.base.clock import RealClock
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.say import say
    from birdcage.rotctld.listening import listen
    from birdcage.rotctld.passed_socket import passed_socket
    from birdcage.rotctld.session_recorder import SessionRecorder

    given = {
        "rotctld.host": host, "rotctld.port": listen_port, "rotctld.allow": ",".join(allow) or None,
        "rotctld.read_only": read_only or None, "rotctld.strict": strict or None,
    }  # fmt: skip
    wants = wanted(given)
    settings = _checked(wants)
    if link is not None and not easycomm:
        raise click.UsageError("--link goes with --easycomm.")
    if easycomm:
        _refuse_of_network({
            "--host": host is not None, "--listen-port": listen_port is not None, "--allow": bool(allow),
            "--strict": strict, "--record": record is not None, "--selftest": selftest,
        })  # fmt: skip
    if moves and not selftest:
        raise click.UsageError("--moves goes with --selftest.")
    if selftest:
        _self_test(wants, moves=moves, survey=not skip_init)
        return
    if print_gpredict or print_satnogs:
        if print_gpredict and print_satnogs:
            raise click.UsageError("Print one at a time: --print-gpredict or --print-satnogs.")
        _print_settings(wants, gpredict=print_gpredict, given=host is not None or listen_port is not None)
        return
    if print_systemd is not None:
        given_here = {
            "--host": (host,), "--listen-port": (listen_port,), "--allow": allow, "--read-only": (read_only,),
            "--strict": (strict,), "--skip-init": (skip_init,), "--easycomm": (easycomm,),
            "--link": (link and str(link.absolute()),), "--record": (record and str(Path(record).absolute()),),
        }  # fmt: skip
        _print_unit(wants, print_systemd, given_here)
        return
    if easycomm:
        from birdcage.cli.serve_serial import serve_serial

        with reach_dish(_reached(wants), "birdcage serve", moves=True, survey=not skip_init) as dish:
            serve_serial(dish, wants, link)
    # First of all: a port that is taken is told before the dish is asked anything, and early clients wait in line.
    with ExitStack() as stack:
        listener = stack.enter_context(passed_socket() or listen(settings.host, settings.port))
        recorder = None
        if record is not None:
            recorder = SessionRecorder(Path(record), RealClock(), say)
            stack.callback(recorder.close)
        wants = _reached(wants)
        with reach_dish(wants, "birdcage serve", moves=True, survey=not skip_init) as dish:
            _serve(dish, wants, listener, recorder)


def _refuse_of_network(given: Mapping[str, bool]) -> None:
    """UsageError for an option that has a meaning only where the network is served."""
    for option in (each for each, is_given in given.items() if is_given):
        raise click.UsageError(f"{option} is for the network, which --easycomm does not serve.")


def _reached(wants: Wanted) -> Wanted:
    """Return the dish with a firmware to be spoken, and say which it is, or who has the port."""
    from birdcage.cli.owners import owners_of
    from birdcage.cli.say import say
    from birdcage.cli.which import with_firmware

    if owners_of(replace(wants, port_given=True)):
        say(f"Another birdcage program has {wants.port}. Clients reach the dish through it.")
        return wants
    wants = with_firmware(wants)
    if wants.firmware_given:
        return wants
    say(f"Firmware unknown, so {wants.firmware} is tried. Name it with --firmware if the dish comes later.")
    return replace(wants, firmware_given=True)


def _self_test(wants: Wanted, *, moves: bool, survey: bool) -> None:
    """Test, and exit 1 where not all is good. A simulated dish inside this program is moved without asking."""
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.self_test_run import run_self_test

    moves = moves or wants.port.startswith("sim:")
    with reach_dish(_reached(wants), "birdcage serve", moves=moves, survey=survey) as dish:
        good = run_self_test(dish, wants, moves=moves)
    if not good:
        raise click.exceptions.Exit(exits.NOT_DONE)


def _checked(wants: Wanted) -> RotctldSettings:
    """Return how to serve. ConfigError if some of it could not be read: its default may let more clients in."""
    from birdcage.base.errors import ConfigError

    wrong = [problem for problem in wants.settings.problems if (problem.key or "").startswith("rotctld")]
    if wrong:
        raise ConfigError("Nothing is served before that is fixed.")
    return wants.settings.rotctld


def _print_settings(wants: Wanted, *, gpredict: bool, given: bool) -> None:
    """Print what a client is to be told. `given`: the command line says where the server listens."""
    from birdcage.cli.client_settings import (
        gpredict_file,
        gpredict_folder,
        limits_of_dish,
        satnogs_variables,
        state_of_owner,
        where_it_listens,
    )
    from birdcage.cli.say import say, tell

    state = state_of_owner(wants)
    place = where_it_listens(wants.settings.rotctld, None if state is None else state.network, given=given)
    if gpredict:
        tell(gpredict_file(place, limits_of_dish(wants, state)))
        say(f"Save it as {gpredict_folder() / 'birdcage.rot'}. Gpredict's Antenna Control then lists birdcage.")
        say("If Gpredict runs on another computer, put this computer's address after Host=.")
    else:
        tell(satnogs_variables(place))
        say("Put them into the environment of satnogs-client: with satnogs-setup, or its compose file.")


def _print_unit(wants: Wanted, kind: str, given: Mapping[str, Sequence[object]]) -> None:
    """Print a unit for systemd. `given`: the options of this command with their values; None and False: not given."""
    from birdcage.base.errors import ConfigError
    from birdcage.cli.say import tell
    from birdcage.cli.systemd_unit import server_unit, socket_unit

    settings = wants.settings.rotctld
    if kind == "socket":
        try:
            tell(socket_unit(settings.host, settings.port))
        except OSError as error:
            raise ConfigError(f"No address is known for {settings.host}. Name one with --host.") from error
        return
    words = [
        word
        for option, values in given.items()
        for value in values
        if value is not None and value is not False
        for word in ([option] if value is True else [option, str(value)])
    ]
    tell(server_unit(wants, words))


def _serve(dish: StationCommand, wants: Wanted, listener: socket.socket, recorder: SessionRecorder | None) -> None:
    from birdcage.cli.dish import DishSession
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.station_desk import serve_desk
    from birdcage.cli.station_run import run_station
    from birdcage.rotctld.listening import wide_warning
    from birdcage.rotctld.options import options_from
    from birdcage.rotctld.recogniser import Recogniser
    from birdcage.rotctld.server import RotctldService

    as_json, settings = flags().json, wants.settings.rotctld
    station = dish.session.station if isinstance(dish, DishSession) else None
    recogniser = None
    if isinstance(dish, DishSession):  # else its plans would be another program's to carry out
        recogniser = Recogniser(dish.session.clock, wants.paths, wants.load, on=settings.recognise)
    service = RotctldService(
        dish.station, listener, settings, options_from(wants.settings),
        show=dish.show_network, tell=lambda news: _tell(news, dish if as_json else None),
        recorder=recorder, recogniser=recogniser,
    )  # fmt: skip
    host, port = service.address
    if as_json:
        tell_json({"v": 1, "type": "Listening", "host": host, "port": port})
    say(f"Listening on {host} port {port}. In Gpredict: Preferences, Interfaces, Rotators. Ctrl+C ends it.")
    warning = wide_warning(host, port, settings.networks, read_only=settings.read_only)
    if warning:
        say(warning)
        if station is not None:
            station.warn(NETWORK, warning)

    def check() -> None:
        if service.crash is not None:
            raise service.crash

    with ExitStack() as stack:
        if isinstance(dish, DishSession):
            stack.enter_context(serve_desk(dish, wants))
        service.start()
        stack.callback(service.shutdown)
        run_station((dish,), as_json=as_json, each_time=check)


def _tell(news: ClientNews, as_json: StationCommand | None) -> None:
    """Tell of a client that came, is gone, or was not let in: for this command as JSON, too. On the server's thread."""
    from birdcage.cli.say import say
    from birdcage.cli.station_run import tell_while_read
    from birdcage.rotctld.client_words import words_of_news

    client = news.client
    if as_json is not None:
        tell_while_read(as_json, {
            "v": 1, "type": "ClientCame" if news.why is None else "ClientLeft", "name": client.name,
            "program": client.program.value or None, "address": client.address, "why": news.why,
        })  # fmt: skip
    say(words_of_news(news))
