"""The published commands of ours: hear the signal, switch the supply of the LNB on, ask whether both are there."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.result import DONE, AwaitedResult, CommandResult, keyed
from birdcage.rotctld.rotor import SignalCounts
from birdcage.rotctld.rprt import RotctldError, Rprt

USUAL_READS = 10
MOST_READS = 1000
"""A read takes milliseconds, and meanwhile the dish answers to no one else."""


def get_rssi(client: ClientContext, arguments: Sequence[str]) -> AwaitedResult:
    """Tell how often the signal was read, the average and the last of it, in counts of the dish's receiver."""
    reads = int(arguments[0]) if arguments else USUAL_READS
    if not 1 <= reads <= MOST_READS:
        raise RotctldError(Rprt.EINVAL, f"{reads} reads are outside 1 to {MOST_READS}. Send 1 to {MOST_READS}.")
    return AwaitedResult(client.rotor.read_signal(reads), _counts)


def enable_lna(client: ClientContext, _: Sequence[str]) -> AwaitedResult:
    """Switch the supply of the LNB on."""
    return AwaitedResult(client.rotor.enable_lna(), lambda _: DONE)


def get_caps(client: ClientContext, _: Sequence[str]) -> CommandResult:
    """Tell which of the two this dish can do."""
    line = (f"CAPS:{','.join(client.rotor.abilities())}",)
    return CommandResult(line, line)


def _counts(counts: SignalCounts) -> CommandResult:
    return keyed(("Reads", "Average", "Current"), f"{counts.reads}", f"{counts.average}", f"{counts.current}")
