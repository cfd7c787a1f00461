"""Whole machines at a port: asked last, each by its own question that moves nothing (`LineProbe`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from birdcage.base.clock import Clock, WaitOutcome
from birdcage.base.wake import Wake
from birdcage.detection.probe import LISTEN_S, BaudFinding, finding_of
from birdcage.link.port import Port
from birdcage.rotator import machines
from birdcage.rotator.line_probe import LineProbe


def probes() -> Mapping[str, LineProbe]:
    """Return what the machines offer that have a language of their own, by name."""
    found = {name: getattr(machines.class_of(name), "probe", None) for name in machines.names_in(machines.MACHINES)}
    return {name: probe for name, probe in found.items() if probe is not None}


def questions() -> Mapping[tuple[bytes, int], tuple[str, ...]]:
    """Return what is asked at which rate, and the machines that would answer it; a rate of 0 is any."""
    asked: dict[tuple[bytes, int], tuple[str, ...]] = {}
    for name, probe in probes().items():
        key = probe.ask, machines.facts_of(name).baud
        asked[key] = (*asked.get(key, ()), name)
    return asked


def ask(
    link: Port, clock: Clock, baud: int, question: bytes, *, listen_s: float = LISTEN_S, wake: Wake | None = None,
    on_wake: Callable[[], None] = lambda: None,
) -> BaudFinding:  # fmt: skip
    """Send a question over `link`, which is open at `baud`, and say what came in time. LinkError without a port.

    `on_wake` is called when `wake` is set; it clears it, and may raise to end the wait.
    """
    began, heard = clock.monotonic(), b""
    link.write(question)
    while clock.monotonic() < began + listen_s:
        outcome = clock.wait(link, began + listen_s, wake)
        if outcome is WaitOutcome.INTERRUPTED:
            on_wake()
        elif outcome is WaitOutcome.READY:
            heard += link.read()
    return finding_of(baud, heard, clock.monotonic() - began)


def answered(finding: BaudFinding) -> list[tuple[str, str]]:
    """Return the machines whose answer stands in what came, each with the words for a person."""
    lines = [line.strip() for line in finding.text.splitlines()]
    return [
        (name, f"`{probe.said}` is answered `{line}`")
        for name, probe in probes().items()
        for line in lines
        if probe.answer.fullmatch(line)
    ]


def marked_lines(finding: BaudFinding) -> list[tuple[str, str]]:
    """Return the machines whose own words stand in what came unasked."""
    return [(name, mark) for name, probe in probes().items() for mark in probe.log_marks if mark in finding.text]
