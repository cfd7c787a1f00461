"""What goes wrong at the dish, as data."""

from __future__ import annotations

from birdcage.sim.g2.sleep import TIMER

from .fault import ANY, CONSOLES, FAR, MOVING, REST, Expect, Fault, nothing, skew, timed
from .stage import Stage


def blocks(axis: int):
    """Return what blocks an axis."""
    return lambda stage: stage.device.stall(axis)


def frees(axis: int):
    """Return what frees an axis."""
    return lambda stage: stage.device.stall(axis, blocked=False)


def obstruct(stage: Stage) -> None:
    """Put something solid into the way of the azimuth: it meets a stop 40 degrees before its target."""
    axis, now = stage.device.dish.axes[0], stage.device.machine.dish_s
    ends = axis._gear if stage.has_menus else axis.data
    stage.stops = ends.low_deg, ends.high_deg
    ends.high_deg = axis.count(now)[0] + FAR[stage.dialect][0] - stage.truth.az_deg - 40.0


def clear(stage: Stage) -> None:
    axis = stage.device.dish.axes[0]
    ends = axis._gear if stage.has_menus else axis.data
    ends.low_deg, ends.high_deg = stage.stops


def reboot(stage: Stage) -> None:
    stage.device.reboot()


def brown_out(stage: Stage) -> None:
    stage.device.brown_out()


def quiet_brown_out(stage: Stage) -> None:
    stage.device.brown_out(quiet=True)


def deadlock(stage: Stage) -> None:
    stage.device.deadlock()


def power_cycle(stage: Stage) -> None:
    stage.device.power_cycle()


def refuse(stage: Stage) -> None:
    """Have the firmware refuse every motion."""
    menu = stage.device.shell._menus[stage.motor_menu]
    ran = menu.run

    def run(words):
        if len(words) > 1 and words[0] in ("a", "g"):
            yield f"{stage.device.settings.bad_parameter}\n"
        else:
            yield from ran(words)

    menu.run = run


def obey(stage: Stage) -> None:
    del stage.device.shell._menus[stage.motor_menu].run


def wander(stage: Stage) -> None:
    stage.device.wander(0, 40.0)


def fall_asleep(stage: Stage) -> None:
    """Let the time of NVS 38 be over."""
    board = stage.device.board
    board.sleep._heard_s = board.now_s - board.nvram.active[TIMER]


STALLED = {MOVING: Expect(fault="stall", held="fault", motion="stall", stop="at once|after a look")}
"""Once it is told, its model is gone: STOP aims by two readings."""
LONG = {REST: 20.0, MOVING: 30.0}
BOOT = {REST: 40.0, MOVING: 45.0}
RESTARTED = {
    REST: Expect("silent|-", fault="reboot|unhomed", held="fault|link"),
    MOVING: Expect("silent|-", fault="reboot|unhomed", held="fault|link", motion="fault|link|stopped", stop=ANY),
}  # fmt: skip

DISH_FAULTS = (
    Fault(
        "stall az", "Azimuth is blocked", blocks(0), frees(0), lasts_s=LONG,
        expect={**STALLED, **timed("x1 in mid-move", "x2 in mid-move", fault="stall", held="fault", motion="stall")},
    ),
    Fault(
        "stall el", "Elevation is blocked", blocks(1), frees(1), expect=STALLED, lasts_s=LONG, strikes_s=0.7
    ),
    Fault(
        "stall sk", "Skew is blocked", blocks(2), frees(2), lasts_s=LONG, motion=skew,
        dialects=("hal205", "hal000", "pro"),
        expect={
            MOVING: Expect(fault="stall", held="fault", motion="stall", stop="nothing"),
            "pro in mid-move": Expect(fault="stall", held="fault", motion="stall", stop="at once"),
        },
    ),
    Fault(
        "limit", "An axis meets a stop before its target", obstruct, clear, expect=STALLED, before=True, lasts_s=LONG
    ),
    Fault(
        "refused", "The dish refuses the command", refuse, obey, before=True, dialects=CONSOLES,
        expect={
            MOVING: Expect(motion="not_taken", stop="nothing|after a look|at once"),
            "hal205 in mid-move": Expect(motion="bad_parameter", stop="nothing|after a look"),
            "hal000 in mid-move": Expect(motion="bad_parameter", stop="nothing|after a look"),
            "pro in mid-move": Expect(motion="bad_parameter", stop="nothing|after a look"),
            **timed("x1 in mid-move", motion="bad_parameter"),
        },
    ),
    Fault(
        "no answer", "It answers a move with nothing", nothing, dialects=("g2",), options={"g2": "&move_reply=none"},
        expect={MOVING: Expect(motion="arrives")},
    ),
    Fault(
        "waits", "It takes no command before its motor rests", nothing, dialects=("g2",),
        options={"g2": "&second_move=block&second_other=block"}, lasts_s=LONG,
        expect={MOVING: Expect(motion="arrives", stop="nothing")},
    ),
    Fault(
        "dozes", "Asleep after NVS 38: the next byte wakes it, and is lost", fall_asleep, dialects=("g2",),
        options={"g2": "&sleep=wake"}, expect={REST: Expect("silent|-", held="link|-")},
    ),
    Fault(
        "asleep", "Asleep after NVS 38: silent until it is switched off and on", fall_asleep, power_cycle,
        dialects=("g2",), options={"g2": "&sleep=silent"}, own_motion=True,
        expect={REST: Expect("silent", fault="reboot", held="link")},
    ),
    Fault("reboot", "The dish restarts", reboot, own_motion=True, lasts_s=BOOT,
        expect={
            **RESTARTED, **timed("x1 at rest", link="silent", fault="reboot", held="link"),
            **timed("x1 in mid-move", "x2 in mid-move", fault="reboot", held="fault", motion="fault"),
        }),
    Fault("brown-out", "A brown-out: it restarts, homing forgotten", brown_out, expect=RESTARTED, lasts_s=LONG),
    Fault(
        "quiet brown-out", "A brown-out without a word", quiet_brown_out, lasts_s=LONG, dialects=CONSOLES,
        expect={
            REST: Expect("silent|-", fault="unhomed", held="link|fault"),
            MOVING: Expect("silent|-", fault="unhomed", held="link|fault", motion="link|fault|stopped"),
            "pro at rest": Expect("silent|-", fault="reboot", held="link|fault"),
            "pro in mid-move": Expect("silent|-", fault="reboot", held="link|fault", motion="fault|link|stopped"),
            **timed("x1 at rest", fault="reboot", held="fault"),
            **timed("x1 in mid-move", fault="reboot", held="fault", motion="fault"),
            **timed("x2 in mid-move", link="silent", fault="reboot", held="link", motion="link"),
        },
    ),
    Fault(
        "deadlock", "The shell is deadlocked; a power cycle ends it", deadlock, power_cycle, own_motion=True,
        expect={
            REST: Expect("silent", fault="reboot", held="link"),
            MOVING: Expect("silent", fault="reboot", held="link", motion="link"),
            # No line of its boot log is known.
            "g2plus at rest": Expect("silent", fault="unhomed", held="link"),
            "g2plus in mid-move": Expect("silent", fault="unhomed", held="link", motion="link"),
            **timed("x1 in mid-move", "x2 in mid-move", link="silent", fault="reboot", held="link", motion="link"),
        },
    ),
    Fault(
        "wander", "It moves unasked", wander, own_motion=True,
        expect={
            REST: Expect(fault="moved", held="fault", stop="after a look"),
            **timed("x1 at rest", "x2 at rest", misled=True),  # nothing tells
        },
    ),
)  # fmt: skip
"""Every way in which the dish itself misbehaves."""
