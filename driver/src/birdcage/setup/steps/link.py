"""Step 1: the wire."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from birdcage.base.config.edit import Value
from birdcage.base.machine_port import machine_at
from birdcage.base.reason import Reason
from birdcage.detection.detecting import heard_firmware
from birdcage.detection.probe import BaudFinding, Saw
from birdcage.setup.case import Case, Cause, describe
from birdcage.setup.causes import find_causes
from birdcage.setup.context import SetupContext
from birdcage.setup.step import Choice, Field, Mark, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.steps.firmware import OTHER, other_firmwares, speak_another
from birdcage.setup.wiring import FOUR_WIRES
from birdcage.station.known import PortInfo, SystemFacts
from birdcage.station.requests import Connect, ProbePort
from birdcage.station.state import Activity, FaultReason, LinkPhase

LIST_S = 2.0
"""How often the ports of the machine are listed, in seconds, while this step waits."""
ANSWER_S = 8.0
"""How long an answer is waited for after the port was changed, in seconds."""
BOOT_S = 30.0
"""The same where a dish was heard that may be booting."""
CONTRADICTIONS = (Reason.WRONG_FIRMWARE, Reason.UNKNOWN_COMMAND)
"""Why a dish counts as silent that does answer: its console is not the one that is spoken."""
MOST_PORTS = 9
MOST_CAUSES = 3
"""How many causes are said in the step itself; `Setup.causes` has all."""

_MAKERS = {"0403": "FTDI", "1a86": "WCH", "10c4": "Silicon Labs", "067b": "Prolific", "04d8": "Microchip"}
"""USB vendors of the adapters that people have."""


class LinkStep(Step):
    """Finds the port and the speed at which a dish answers."""

    name = "link"
    title = "Link"
    page = "console"

    def __init__(self, bench: SetupContext) -> None:
        super().__init__(bench)
        self._ports: list[PortInfo] = []
        self._listed_at = 0.0
        self._system: SystemFacts | None = None
        self._looked_at: tuple[str, LinkPhase] | None = None
        self._baud: int | None = None
        """The speed that was asked for here last; None before."""
        self.findings: tuple[BaudFinding, ...] = ()
        """What was seen at each speed."""

    @property
    def mark(self) -> Mark:
        """Whether it answers now; as kept while it is being opened."""
        link, kept = self.bench.state.link.state, self.bench.kept(self.name)
        if kept is not None and kept.skipped and link is not LinkPhase.UP:
            return Mark.SKIPPED
        if self.bench.state.port and link in (LinkPhase.SILENT, LinkPhase.LOST) and not self.busy and not self._boots:
            return Mark.FAILED
        return super().mark

    @property
    def _boots(self) -> bool:
        return self.bench.state.activity is Activity.INITIALIZING

    @property
    def _another(self) -> bool:
        """Whether the console that answers contradicts the firmware that is spoken."""
        link = self.bench.state.link
        return link.state is LinkPhase.SILENT and link.reason in CONTRADICTIONS

    @property
    def _rate(self) -> int:
        """0 of a machine that is not at the end of a serial line."""
        model = self.bench.state.dish
        assert model is not None, "a station knows its dish from the start"
        return self._baud or self.bench.settings.dish.baud or model.baud

    def evidence(self) -> str:
        """Say what is known of the wire."""
        state = self.bench.state
        if self._boots:
            return f"the dish is starting: {state.activity_text}"
        if state.link.state is LinkPhase.UP:
            return self._live()
        if self._another:
            return state.link.detail
        if state.link.state is LinkPhase.SILENT:
            return f"{_short(state.port)} opens. No dish answers{f' at {self._rate} baud' if self._rate else ''}."
        if not state.port:
            return "No port set."
        if state.link.state in (LinkPhase.LOST, LinkPhase.OPENING):
            return state.link.detail
        return super().evidence()

    def _live(self) -> str:
        """Say what was measured when it was kept: a figure that changes with each reply makes the list jump."""
        kept, port = self.bench.kept(self.name), _short(self.bench.state.port)
        same = f"{port}, ", f" {self._rate} 8N1" if self._rate else " answers"
        if kept is not None and kept.done and kept.evidence.startswith(same[0]) and same[1] in kept.evidence:
            return kept.evidence
        return self._measured()

    def _measured(self) -> str:
        state, info = self.bench.state, self._info(self.bench.state.port)
        parts = [_short(state.port)]
        if info is not None and info.vid_pid is not None:
            parts.append(_MAKERS.get(info.vid_pid[:4], info.description or info.vid_pid))
        if self._rate:
            parts.append(f"{self._rate} 8N1")
        trip = state.link.round_trip_s
        parts.append("answers" if trip is None else f"answers in {max(1, round(trip * 1000))} ms")
        return ", ".join(parts)

    def words(self) -> tuple[str, ...]:
        """Say what to do, and what was seen."""
        state = self.bench.state
        if state.link.state is LinkPhase.UP:
            through = f", through {self.bench.via}" if self.bench.via else ""
            return (f"A dish answers on {_short(state.port)}{through}.",)
        if self._another:
            return ("The wires are right. A dish answers, but not the one you chose. Say which.",)
        refreshes = f"The list refreshes every {LIST_S:.0f} seconds."
        if self.bench.via:
            return (f"{self.bench.via} has the port {_short(state.port)}. To use another one, end that program.",)
        words = [f"Choose the port of the RS-422 adapter. Nothing is sent to the others. {refreshes}"]
        if not self._ports and not state.port:
            words = []
        if self.busy:
            words = ["Nothing moves by this."]
        elif state.link.state is LinkPhase.SILENT:
            words = ["The port opens, but no dish answers. Listen at other speeds, or choose another port."]
            if self._heard:
                words = [f"A dish was heard at {self._answering()} baud, but not the one you chose."]
            elif self._answering() is not None:
                words = [f"A dish was heard at {self._answering()} baud: connect at that speed."]
        if not self._ports:
            words += [
                f"No serial port found. Plug the adapter into a USB port of this computer. {refreshes}",
                FOUR_WIRES,
            ]
        if self.findings:
            words.append(f"Seen: {describe(self.findings)}.")
        words += [f"{each.title}: {each.what_to_do}" for each in self.causes()[:MOST_CAUSES]]
        return tuple(words)

    def causes(self) -> tuple[Cause, ...]:
        """Return what may be wrong, likeliest first; empty while the dish answers or boots."""
        state = self.bench.state
        if state.link.state not in (LinkPhase.SILENT, LinkPhase.LOST) or self._boots or self._another:
            return ()
        if not state.port:
            return ()  # nothing was tried, so nothing was seen
        baud = state.dish.baud if state.dish else None
        boot_s = state.dish.boot_s if state.dish else None
        return find_causes(
            Case(
                state.port, state.link, self.findings, self._system, tuple(self._ports), firmware_baud=baud,
                boot_s=boot_s, restarted=state.fault is not None and state.fault.reason is FaultReason.REBOOT,
            )
        )  # fmt: skip

    def choices(self) -> tuple[Choice, ...]:
        """Keep, connect, look at other speeds, or another port."""
        state, choices = self.bench.state, []
        answering = self._answering()
        if state.link.state is LinkPhase.UP:
            choices.append(Choice("keep", "enter", "Use this port"))
        elif answering is not None and not self.bench.via:
            choices.append(Choice("connect", "enter", f"Connect at {answering} baud"))
        if self.bench.via:
            return tuple(choices)  # the program that has the port chooses it
        if self._another:
            return other_firmwares(self.bench, likely=True, rate=self._rate)
        if self._heard:
            choices = [*other_firmwares(self.bench, likely=True, heard=self._heard),
                       Choice("connect", "c", f"Connect at {answering} baud all the same")]  # fmt: skip
        if state.link.state is LinkPhase.SILENT:
            again = " again" if self.findings and answering is None else ""
            probe_key = "enter" if answering is None else "p"
            choices.append(Choice("probe", probe_key, f"Listen at other speeds{again}"))
        for key, info in enumerate(self._ports[:MOST_PORTS], 1):
            maker = "" if info.vid_pid is None else f", {_MAKERS.get(info.vid_pid[:4], info.description or '')}"
            choices.append(Choice(f"port-{key}", str(key), f"{info.device}{maker}"))
        if state.link.state is LinkPhase.SILENT and not self._heard:
            choices += other_firmwares(self.bench)
        field = Field("port", "port", hint="/dev/ttyUSB0, COM4, socket://host:port", value=state.port)
        baud = Field("baud", "speed", "baud", "empty: the firmware's own")
        return (*choices, Choice("other", "t", "Type a port", fields=(field, baud)))

    def _answering(self) -> int | None:
        """Return the speed at which a dish was heard: its prompt, or else text, as of one that boots."""
        for saw in (Saw.PROMPT, Saw.TEXT):
            for each in self.findings:
                if each.saw is saw:
                    return each.baud
        return None

    @property
    def _heard(self) -> str:
        """Return the firmware that was heard, where it is not the one that is spoken; else empty."""
        state, at = self.bench.state, self._answering()
        if state.link.state is not LinkPhase.SILENT or state.dish is None:
            return ""
        heard = next((heard_firmware(each, state.port) for each in self.findings if each.baud == at), None)
        return "" if heard in (None, state.dish.firmware) else str(heard)

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Change over, or listen."""
        if choice == "keep":
            self._keep()
        elif choice.startswith(OTHER):
            speak_another(self.bench, choice.removeprefix(OTHER))
        elif choice == "probe":
            self.begin(self._probe(), "listening at several speeds, some seconds each")
        elif choice == "connect":
            self._connect(self.bench.state.port, self._answering())
        elif choice == "other":
            port, baud = values.get("port", "").strip(), values.get("baud", "").strip()
            if not port:
                raise NoSuchChoice("Type a port: /dev/ttyUSB0.")
            if baud and not (baud.isdigit() and 50 <= int(baud) <= 4_000_000):
                raise NoSuchChoice(f"{baud!r} is not a speed. Type 115200.")
            self._connect(port, int(baud) if baud else None)
        else:
            self._connect(self._ports[int(choice.removeprefix("port-")) - 1].device, self.bench.settings.dish.baud)

    def _connect(self, port: str, baud: int | None) -> None:
        named, spoken = machine_at(port), self.bench.state.dish
        if named is not None and (spoken is None or spoken.firmware != named):
            speak_another(self.bench, named, port)
            return
        heard = any(each.saw is Saw.TEXT and each.baud == baud for each in self.findings)
        self.findings = ()
        self.begin(self._change_over(port, baud, BOOT_S if heard else ANSWER_S), f"waiting for an answer on {port}")

    def _change_over(self, port: str, baud: int | None, patience_s: float) -> Plan:
        yield self.bench.ask(Connect(port, baud))
        model = self.bench.state.dish
        assert model is not None, "a station knows its dish from the start"
        self._baud = baud or model.baud
        deadline = self.bench.now + patience_s
        while not self.bench.is_up:
            # A dish that boots has its own time; the station follows its text.
            over = self.bench.now > deadline and not self._boots
            if over or self.bench.state.link.state is LinkPhase.LOST:
                return  # the mark and the evidence say so, for as long as it is so
            yield None
        self._keep()

    def _keep(self) -> None:
        self._list()
        state, info = self.bench.state, self._info(self.bench.state.port)
        self.findings = ()
        keys: dict[str, Value] = {
            "dish.port": state.port,
            "dish.baud": self._rate or None,
            "link.usb_identity": info.identity if info else None,
        }
        self.bench.done(self.name, self._measured() + self.bench.overridden("dish.port", "dish.baud"), keys)

    def _probe(self) -> Plan:
        found = yield self.bench.ask(ProbePort())
        assert isinstance(found, tuple), "the station resolves it with findings"
        self.findings = found
        deadline = self.bench.now + ANSWER_S
        while self.bench.state.link.state is LinkPhase.OPENING and self.bench.now < deadline:
            yield None  # the station tries the present speed again

    def look(self) -> None:
        """Keep the list of ports up to date while there is something to choose."""
        state = self.bench.state
        changed = self._looked_at != (state.port, state.link.state)
        self._looked_at = state.port, state.link.state
        if changed or (not self.bench.is_up and self.bench.now - self._listed_at >= LIST_S):
            self._list()
        if changed and state.link.state in (LinkPhase.SILENT, LinkPhase.LOST):
            self._system = self.bench.system(state.port) if state.port else None

    def _list(self) -> None:
        self._ports, self._listed_at = self.bench.ports(), self.bench.now

    def _info(self, port: str) -> PortInfo | None:
        real = str(Path(port).resolve())
        return next((each for each in self._ports if port in (each.device, each.by_id) or each.device == real), None)


def _short(port: str) -> str:
    """Return a port as a line has room for it: without its folder, and an address without its options."""
    return port.removeprefix("/dev/").partition("?")[0]
