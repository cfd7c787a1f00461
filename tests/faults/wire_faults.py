"""What goes wrong between the adapter and the dish, as data."""

from __future__ import annotations

from birdcage.sim.wire import Byte

from .fault import CONSOLES, MOVING, REST, Expect, Fault, timed
from .stage import OTHER_PORT, PORT, TARGET, Stage

RARELY = 0.01
"""The share of the bytes that are lost, doubled or changed: about one in every other answer."""
NOISE = bytes.fromhex("ff 00 c3 7e 91")


def both(**fields):
    """Return what sets fields of both directions."""

    def inflict(stage: Stage) -> None:
        for lane in stage.device.wire.lanes:
            for name, value in fields.items():
                setattr(lane, name, value)

    return inflict


def answers(**fields):
    """Return what sets fields of the way from the dish."""

    def inflict(stage: Stage) -> None:
        for name, value in fields.items():
            setattr(stage.device.wire.to_host, name, value)

    return inflict


def noise_in_numbers(stage: Stage) -> None:
    """Put noise before every decimal point."""
    stage.device.wire.to_host.set_plan(lambda value: Byte(noise=NOISE if value == ord(".") else b""))


def no_plan(stage: Stage) -> None:
    stage.device.wire.to_host.set_plan(None)


def noise(stage: Stage) -> None:
    """Make a crackle now and then, out of step with the answers."""
    if round(stage.now * 10) % 19 == 0:
        stage.device.say(NOISE.decode("latin-1"))


def leading_digit(stage: Stage) -> None:
    """Change the first digit of an answer's first number, in one answer of seven."""
    seen = {"answers": 0, "number": False}
    before = b"=" if stage.has_menus else b"ZL"

    def change(value: int) -> Byte:
        if value in before:
            seen["answers"] += 1
            seen["number"] = seen["answers"] % 14 == 1
        elif seen["number"] and chr(value).isdigit():
            seen["number"] = False
            return Byte(drop=True, noise=b"%d" % ((value - ord("0") + 1) % 10))
        return Byte()

    stage.device.wire.to_host.set_plan(change)


def lose_digit_of_command(stage: Stage) -> None:
    """Lose the first digit of the next angle that is sent."""
    sent: list[int] = []

    def lose(value: int) -> Byte:
        sent.append(value)
        words = bytes(sent).rpartition(b"\r")[2].lstrip().split(b" ")
        angle = (
            len(words) > 1 and words[0] in (b"a", b"g") and words[-1] and len(words) == (3 if words[0] == b"a" else 2)
        )
        if angle or TARGET.fullmatch(bytes(sent).rpartition(b"\n")[2]):
            stage.device.wire.to_dish.set_plan(None)
            return Byte(drop=True)
        return Byte()

    stage.device.wire.to_dish.set_plan(lose)


def no_loss(stage: Stage) -> None:
    stage.device.wire.to_dish.set_plan(None)


def chatter(stage: Stage) -> None:
    stage.device.say("LNB voltage 13.2 V, current 118 mA\n")


def no_echo(stage: Stage) -> None:
    stage.device.wire.echo_loss = True


def echo(stage: Stage) -> None:
    stage.device.wire.echo_loss = False


def close(stage: Stage) -> None:
    stage.port.close()


def unplug(stage: Stage) -> None:
    stage.path = None
    stage.device.unplug()


def plug(stage: Stage, path: str = PORT) -> None:
    stage.path = path
    stage.device.plug()


def plug_elsewhere(stage: Stage) -> None:
    plug(stage, OTHER_PORT)


SILENT = {
    REST: Expect("silent", held="link"), MOVING: Expect("silent", held="link", motion="link"),
}  # fmt: skip
PATCHY = {
    REST: Expect("silent|-", held="link|-"), MOVING: Expect("silent|-", held="link|-", motion="link|arrives"),
}  # fmt: skip
"""An answer that is damaged beyond reading is silence; one that is not is nothing."""
UNNOTICED = {REST: Expect(), MOVING: Expect(motion="arrives")}
GONE = {
    REST: Expect("lost", held="link"), MOVING: Expect("lost", held="link", motion="link"),
    # Whatever may have been without power has to be synced.
    "easycomm at rest": Expect("lost", fault="unhomed", held="link"),
    "easycomm in mid-move": Expect("lost", fault="unhomed", held="link", motion="link"),
}  # fmt: skip

WIRE_FAULTS = (
    Fault(
        "silence", "Silence: no byte gets through", both(silent=True), both(silent=False),
        expect={
            **SILENT,
            **{f"{each} in mid-move": Expect(motion="arrives") for each in ("hal205", "hal000", "pro")},
            **timed("x1 at rest", "x2 at rest", link="silent", held="link"),
            **timed("x1 in mid-move", "x2 in mid-move", link="silent", held="link", motion="link"),
        },
    ),
    # A crackle that stands right before the echo of a line costs its answer, also that of the first line afterwards.
    Fault(
        "noise", "Garbage between answers", noise, again=noise,
        expect={**PATCHY, **timed("x1 at rest"), **timed("x1 in mid-move", motion="arrives")},
    ),
    Fault("garbled", "Garbage inside every answer", noise_in_numbers, no_plan, expect=SILENT),
    Fault("dropped", "One byte in 100 is lost, each way", both(drop=RARELY), both(drop=0.0), expect=PATCHY),
    Fault("doubled", "One byte in 100 comes twice, each way", both(double=RARELY), both(double=0.0), expect=PATCHY),
    Fault("corrupted", "One byte in 100 is changed, each way", both(garble=RARELY), both(garble=0.0), expect=PATCHY),
    Fault(
        "digit", "A leading digit of an answer is wrong", leading_digit, no_plan,
        expect={REST: Expect(), MOVING: Expect(motion="arrives")},
    ),
    Fault(
        "command", "A digit of a command is lost on its way", lose_digit_of_command, no_loss, before=True,
        expect={
            MOVING: Expect("silent", held="link", motion="link|blocked|garbage"),
            "easycomm in mid-move": Expect(fault="stall", held="fault", motion="stall"),
            **timed("x1 in mid-move", "x2 in mid-move", link="silent", held="link", motion="link"),
        },
        astray=True,
    ),
    Fault(
        "split", "Answers come byte by byte", answers(pace_baud=1200), answers(pace_baud=0), expect=UNNOTICED
    ),
    Fault(
        "late", "Answers come 1.5 s late", answers(delay_min_s=1.5, delay_max_s=1.5),
        answers(delay_min_s=0.0, delay_max_s=0.0), expect=UNNOTICED,
    ),
    Fault(
        "too late", "Answers come 3 s late", answers(delay_min_s=3.0, delay_max_s=3.0),
        answers(delay_min_s=0.0, delay_max_s=0.0), expect=SILENT,
    ),
    Fault("no echo", "The echo is missing", no_echo, echo, dialects=CONSOLES,
        expect={**SILENT, **timed("x1 at rest", link="silent", held="link")}),
    Fault("unsolicited", "Lines without a question", chatter, again=chatter, expect=UNNOTICED),
    Fault("closed", "The system closes the port, which is there", close, expect=GONE, port=False),
    Fault("unplugged", "The adapter is unplugged and comes back", unplug, plug, port=False,
        expect={
            **GONE, **timed("x1 at rest", link="lost", held="link"),
            **timed("x1 in mid-move", "x2 in mid-move", link="lost", held="link", motion="link"),
        }),
    Fault(
        "elsewhere", "The adapter comes back under another name", unplug, plug_elsewhere, expect=GONE, port=False
    ),
)  # fmt: skip
"""Every way in which bytes go astray."""
