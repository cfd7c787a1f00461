"""`birdcage serve --selftest`: a server on a port of its own, over this dish, and what clients would make of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from birdcage.base.errors import ConfigError, LinkError, NoReply
from birdcage.cli.dish import READ_S, why_unknown
from birdcage.cli.options import flags
from birdcage.cli.say import say, tell, tell_json
from birdcage.rotctld.listening import listen
from birdcage.rotctld.motion_test import motion_test
from birdcage.rotctld.options import options_from
from birdcage.rotctld.recorded_session import NAMES
from birdcage.rotctld.self_test import SelfTestResult, SelfTestVerdict, self_test
from birdcage.rotctld.server import RotctldService
from birdcage.station.state import LinkPhase

if TYPE_CHECKING:
    from birdcage.base.config import RotctldSettings
    from birdcage.cli.options import Wanted
    from birdcage.cli.station_command import StationCommand
    from birdcage.station.state import StationState

COME_UP_S = 15.0
"""How long the dish may take to answer; the test then goes on without it."""
MOST_SHOWN = 2
"""Lines of an answer that are shown whole."""


@dataclass(slots=True)
class _Tally:
    good: int = 0
    bad: int = 0


def run_self_test(dish: StationCommand, wants: Wanted, *, moves: bool) -> bool:
    """Say to a server what clients say, and print a line for each exchange; return whether all is good.

    `moves`: wishes are carried out, and one more is seen through. Without it the server takes none.
    """
    settings, options = wants.settings.rotctld, options_from(wants.settings)
    moves = moves and not settings.read_only
    if not moves:
        # Not strict either: that would refuse the wishes, and it is this test that takes none.
        settings = replace(settings, read_only=True, strict=False)
        options = replace(options, read_only=True, strict=False)
    _await_dish(dish)
    tally = _Tally()
    _check_port(wants.settings.rotctld, dish.state, tally)
    with listen("127.0.0.1", 0) as listener:
        service = RotctldService(dish.station, listener, settings, options)
        service.start()
        try:
            for result in _results(service.address, dish, moves=moves):
                _tell(result, dish.state, tally)
                dish.look()
        finally:
            service.shutdown()
    say(f"{tally.good} good, {tally.bad} not." if tally.bad else f"All {tally.good} good.")
    if wants.settings.rotctld.read_only:
        say("Nothing was moved: clients may look only (--read-only, or [rotctld] read_only).")
    elif not moves:
        say("Nothing was moved. --moves tries that, too: the dish then goes where the recorded sessions point.")
    return not tally.bad


def _results(address: tuple[str, int], dish: StationCommand, *, moves: bool) -> Iterator[SelfTestResult]:
    for name in NAMES:
        yield from self_test(address, name)
    if moves:
        yield motion_test(address, dish.look)


def _await_dish(dish: StationCommand) -> None:
    """Wait for the dish and its first reading; say what is wrong where that does not come."""
    try:
        dish.come_up(COME_UP_S, patient=True)
    except (LinkError, NoReply) as error:
        say(f"{error} The test goes on without the dish.")
        return
    until = dish.now + READ_S
    while dish.state.position is None and dish.state.homed is not False and dish.now < until:
        dish.look()


def _check_port(settings: RotctldSettings, state: StationState, tally: _Tally) -> None:
    """Say whether `birdcage serve` could listen where it is set to."""
    advice = ""
    running = state.network is not None and state.network.port == settings.port
    if not running:
        try:
            listen(settings.host, settings.port).close()
        except ConfigError as error:
            advice = str(error)
    tally.good, tally.bad = tally.good + (not advice), tally.bad + bool(advice)
    came = "taken" if advice else "birdcage listens there" if running else "free"
    _print("server", f"{settings.host}:{settings.port}", "wrong" if advice else "good", came, advice)


def _tell(result: SelfTestResult, state: StationState, tally: _Tally) -> None:
    tally.good, tally.bad = tally.good + result.good, tally.bad + (not result.good)
    advice = "" if result.good else advice_on(result, state)
    lines = result.came.decode("ascii", "replace").splitlines()
    came = " ".join(lines) if len(lines) <= MOST_SHOWN else f"{len(lines)} lines"
    sent = " ".join(result.sent.decode("ascii", "replace").split())
    _print(result.program, sent, result.verdict.value, came or "-", advice, round(result.took_s, 4))


def _print(program: str, sent: str, verdict: str, came: str, advice: str, took_s: float | None = None) -> None:
    if flags().json:
        tell_json({
            "v": 1, "type": "Check", "program": program, "sent": sent, "verdict": verdict, "came": came,
            "took_s": took_s, "advice": advice or None,
        })  # fmt: skip
        return
    tell(f"{program:9} {sent:26} {verdict:8} {came}".rstrip())
    if advice:
        tell(f"{'':9} {advice}")


def advice_on(result: SelfTestResult, state: StationState) -> str:
    """Return what a program would make of an exchange that is not good, and what to do."""
    match result.verdict:
        case SelfTestVerdict.SILENT:
            return f"{result.program} waits, and gives up. `birdcage status` tells whether the dish answers."
        case SelfTestVerdict.UNREACHED:
            return "The server takes no connection. A firewall on this computer may block 127.0.0.1."
        case SelfTestVerdict.TORN:
            return f"{result.program} takes the first piece for the whole answer. Please report this."
        case SelfTestVerdict.SLOW:
            return f"{result.took_s:.1f} s: {result.program} follows late. Is this computer, or the line, overloaded?"
        case _:
            pass
    if result.code in (-5, -6):
        gives_up = f"{result.program} would disengage, or show an error."
        if state.link.state is not LinkPhase.UP:
            return f"{gives_up} {state.link.detail or 'The dish does not answer.'}"
        return f"{gives_up} {why_unknown(state)}" if state.position is None else gives_up
    if result.code == -9:
        return f"{result.program} would stop. Refused: --strict, or [rotctld] strict, answers so. Leave it off."
    if result.sent.startswith(b"P") and result.code is None:
        return "The dish did not get there. `birdcage status` tells who has control, and whether it is HELD."
    return f"{result.program} does not understand this answer. Please report this."
