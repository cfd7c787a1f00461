"""What the console tests share: the dialect, and faults as hypothesis draws them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from birdcage.base.clock import Endpoint, VirtualClock, WaitOutcome
from birdcage.base.errors import BirdcageError, Cancelled
from birdcage.base.wake import Wake
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.session import Console
from birdcage.link.port import Port
from birdcage.protocol.hal import HAL000Protocol, HAL205Protocol, TravlerProProtocol
from birdcage.sim.wire import PASS, Byte
from hypothesis import strategies as st

D = 2.0
HAL = HAL205Protocol.dialect
DIALECT = ConsoleDialect(
    prompts={"root": "TRK>", "mot": "MOT>", "dvb": "DVB>", "nvs": "NVS>", "os": "OS>"},
    refusals=((re.compile(r"Invalid (command|parameter)"), "unknown_command"),),
)


LEARNT = ConsoleDialect(
    prompts=dict.fromkeys(("root", "mot", "dvb", "nvs"), ""),
    refusals=DIALECT.refusals,
    root_marks=frozenset({"mot", "dvb"}),
    root_hints=frozenset({"nvs", "reboot"}),
    submenu_marks={"mot": frozenset("ah"), "dvb": frozenset({"agc"}), "nvs": frozenset("de")},
)
TRAVLERS = {
    "hal205": {"dialect": HAL205Protocol.dialect, "names": {"mot": "motor", "dvb": "ngsearch", "agc": "?"}},
    "hal000": {"dialect": HAL000Protocol.dialect, "names": {"dvb": "os", "agc": "?"}},
    "pro": {"dialect": TravlerProProtocol.dialect, "names": {"dvb": "os", "agc": "?"}},
}
"""The Trav'lers, and what the drawn steps mean on each."""


class NudgingClock(VirtualClock):
    """Sets a wake in the n-th wait from now, as a key pressed in mid-exchange does."""

    def __init__(self) -> None:
        super().__init__()
        self.wake = Wake()
        self.countdown = 0

    def wait(self, endpoint: Endpoint | None, until: float, wake: Wake | None = None) -> WaitOutcome:
        if self.countdown:
            self.countdown -= 1
            if not self.countdown:
                self.wake.set()
        return super().wait(endpoint, until, wake)


class Faults:
    """What happens to the bytes of one direction, one by one; `lag_s` holds for all of them."""

    def __init__(self, faults) -> None:
        self.lag_s = 0.0
        self._actions = self._plan(faults)

    @staticmethod
    def _plan(faults):
        for skip, kind, late_s, noise in faults:
            for _ in range(skip):
                yield PASS
            yield Byte(drop=kind == "drop", double=kind == "double", delay_s=late_s, noise=noise)

    def __call__(self, value: int) -> Byte:
        action = next(self._actions, PASS)
        return replace(action, delay_s=max(action.delay_s, self.lag_s))

    def scripted(self, value: int) -> list[tuple[float, bytes]]:
        action = self(value)
        data = b"" if action.drop else bytes([value]) * (2 if action.double else 1)
        return [(action.delay_s, bytes([one])) for one in action.noise + data]


# One fault: how many bytes pass first, whether its byte is lost or doubled, how late it is, noise before it.
NOISE = st.binary(min_size=0, max_size=2).map(lambda data: data.replace(b"q", b"~").replace(b"Q", b"~"))
FAULTS = st.lists(
    st.tuples(
        st.one_of(st.integers(0, 6), st.integers(0, 40)),
        st.sampled_from(["pass", "drop", "double"]),
        st.sampled_from([0.0, 0.0, 0.3, 1.0, 1.9, 2.0]),
        st.one_of(st.just(b""), NOISE),
    ),
    max_size=12,
)
COMMANDS = ["a", "a 0 12", "?", "", "mot", "dvb", "rssi 3", "freqs", "q", "h 0", "x y"]
LAGS = st.sampled_from([0.0, 0.0, 0.0, 0.5, 1.5, 2.0])
"""How late every byte of one direction is, for the length of a step."""
NUDGES = st.tuples(st.sampled_from(["cancel", "interject"]), st.integers(1, 12))
STEPS = st.lists(
    st.tuples(
        st.tuples(LAGS, LAGS),
        st.one_of(st.none(), st.none(), NUDGES),
        st.one_of(
            st.tuples(st.just("exchange"), st.sampled_from(COMMANDS)),
            st.tuples(st.just("enter"), st.sampled_from(["root", "mot", "dvb", "nvs"])),
            st.tuples(st.just("run"), st.sampled_from([("mot", "a"), ("dvb", "rssi 3"), ("mot", "h 0"), ("mot", "?")])),
            st.tuples(st.just("stream"), st.sampled_from([0.0, 0.35, 3.0])),
            st.tuples(st.just("type"), st.tuples(st.sampled_from(COMMANDS), st.sampled_from(["leave", "key", "drop"]))),
            st.tuples(st.just("wait"), st.sampled_from([0.1, 1.0, 2.5, 9.0])),
            st.tuples(
                st.sampled_from(["leave", "synchronize", "interject", "settle", "leave_all", "renew"]), st.none()
            ),
        ),
    ),
    min_size=1,
    max_size=14,
)


class Owner:
    """Does what a drawn step says, and swallows what a station would handle."""

    def __init__(
        self, port: Port, clock: NudgingClock, dialect: ConsoleDialect = DIALECT, names: Mapping[str, str] | None = None
    ) -> None:
        self.port, self.clock, self.dialect = port, clock, dialect
        self.names = names or {}
        self.nudge = ""
        self.renew()

    def renew(self) -> None:
        self.console = Console(
            self.port, self.clock, self.dialect, delay_s=D, wake=self.clock.wake, on_wake=self.woken,
            on_line=lambda _: None,
        )  # fmt: skip

    def named(self, word: object) -> str:
        return self.names.get(str(word), str(word))

    def woken(self) -> None:
        self.clock.wake.clear()
        if self.nudge == "cancel":
            raise Cancelled("test")
        self.console.interject(["a 0 12", "a 1 30"])

    def step(self, nudge: tuple[str, int] | None, action: tuple[str, object]) -> None:
        self.nudge, self.clock.countdown = nudge or ("", 0)
        try:
            self._act(*action)
        except BirdcageError:
            pass
        finally:
            self.clock.countdown = 0

    def _act(self, name: str, value: object) -> None:
        console, now = self.console, self.clock.monotonic()
        match name:
            case "exchange":
                console.exchange(self.named(value), takes_s=15.0 if value == "h 0" else 0.0)
            case "run":
                console.run(self.named(value[0]), self.named(value[1]), takes_s=15.0 if value[1] == "h 0" else 0.0)
            case "enter":
                console.enter(self.named(value))
            case "stream":
                console.enter(self.named("dvb"))
                console.stream(self.named("agc"), lambda _: None, now + float(value))
            case "type":
                line, then = value
                typed = console.type_line(self.named(line), takes_s=15.0 if line == "h 0" else 0.0)
                if then == "leave" or typed.wait(0.3) is not None:
                    return  # its reply comes while other things are done
                if then == "key":
                    typed.press_enter()
                    typed.wait(D)
                if typed.reply is None:
                    typed.give_up()
            case "interject":
                console.interject(["a 0 20", "a 1 31"])
            case "settle":
                console.settle(D)
            case "wait":
                self.clock.advance(float(value))
            case "renew":
                self.renew()
            case _:
                getattr(console, name)()
