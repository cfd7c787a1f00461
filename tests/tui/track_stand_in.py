"""A pursuit desk to show: plans on great circles, looks at how well the dish points, and every phase."""

from __future__ import annotations

import math
from dataclasses import replace

import sky_stand_in
import stand_in
from birdcage.base.geometry import separation
from birdcage.base.held import HeldReason
from birdcage.pursuit.now import DeskNow, Mode, Scheduled, TargetMatch, Unfinished
from birdcage.radio import peer
from birdcage.radio.now import RadioNow, RadioState
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.sky.look import LookAngle
from birdcage.sky.skew import Skew
from birdcage.station.pursuit_state import Phase, PointingSample, Pursuit, PursuitOptions
from birdcage.station.state import Activity, HeldState
from birdcage.tracking.plan import PlanTarget
from birdcage_tui.shown.view import SignalSample as Heard
from track_plans import NOON, believed, geo, moon, plan, utc


class Elements:
    """What a row of a pass needs to have."""


def looks(of, upto_s=NOON, clock_now=0.0):
    """How well the dish has pointed, a look a second, up to a moment."""
    found = []
    for leg in of.legs:
        t_s = leg.start_s
        while t_s <= min(leg.end_s, upto_s):
            az_deg, el_deg = of.sky.at(t_s)
            off = 0.025 * math.sin(t_s / 7.0) + (0.02 * math.sin(t_s * 1.3))
            here = (az_deg + off / max(math.cos(math.radians(el_deg)), 0.1), el_deg + 0.4 * off)
            error = separation(az_deg, el_deg, *here)
            found.append(PointingSample(
                clock_now + t_s - NOON, utc(t_s), az_deg % 360, el_deg, az_deg % 360, el_deg, (az_deg + 0.3) % 360,
                el_deg + 0.1, here[0] % 360, here[1], error, None if (seen := believed(of, t_s, error)) is None
                else 12.0 * (seen / 2.6) ** 2, seen,
            ))  # fmt: skip
            t_s += 1.0
    return found


FOUND = (
    TargetMatch("59051", "METEOR-M2 4", "satellite", "59051 · 6 h old", favourite=True),
    TargetMatch("25544", "ISS (ZARYA)", "satellite", "25544 · 2 h old", favourite=True),
    TargetMatch("43689", "METOP-C", "satellite", "43689 · 6 h old", favourite=True),
    TargetMatch("sun", "Sun", "body"),
    TargetMatch("moon", "Moon", "body"),
)


def schedule():
    rows = []
    for name, number, minutes, length, _, _, top, favourite, _ in sky_stand_in.PASSES:
        if favourite:
            start = NOON + (minutes + 2) * 60
            clash = name == "ISS (ZARYA)" and minutes > 60
            rows.append(Scheduled(name, number, utc(start), utc(start + (length - 4) * 60), (length - 4) * 60.0,
                                  float(top), float(min(top, 65)), 0,
                                  not clash, "overlaps METEOR-M2 4 (priority 2)" if clash else ""))  # fmt: skip
    return tuple(rows)


def rows_of(plans):
    from birdcage.sky.pass_row import Distance, PassRow

    far = Distance(2000.0, 0.0)
    return tuple(
        PassRow(each.passing, Elements(), each.reach, 1.0, None, far, far, far, True) for each in plans
    )  # fmt: skip


def desk(of=None, **changes):
    """What the desk shows of a plan."""
    later = () if of is None or of.passing is None else tuple(
        plan(of.aim.name, of.aim.norad_id, minutes, 12, 320 - index * 40, 190, top)
        for index, (minutes, top) in enumerate(((97.0, 33.0), (195.0, 24.0), (610.0, 82.0), (707.0, 45.0)))
    )  # fmt: skip
    now = DeskNow(
        utc(NOON), found=FOUND, choice=None if of is None else str(of.aim.norad_id or of.aim.name.lower()),
        aim=None if of is None else of.aim, plan=of,
        passes=() if of is None or of.passing is None else rows_of((of, *later)),
        look=None if of is None else LookAngle(*of.sky.at(NOON)),
        schedule=schedule(),
    )  # fmt: skip
    return replace(now, **changes)


TUNED = RadioNow(RadioState.TUNED, "localhost:4532", "METEOR-M2 4", 137.9e6, -1843.0, 137.898157e6, 137.89815e6, -38.2,
                 recording=True)  # fmt: skip

SDRPP = replace(TUNED, strength_db=None, strength_refused=1)
SDRPP = replace(SDRPP, sentence=peer.remark(SDRPP))


def pursuit(of, phase, why="", next_what="", next_s=None, clock=None, **more):
    return Pursuit(
        3, "tracker", of, PursuitOptions(park_az_deg=301.0, park_el_deg=18.0), phase,
        (clock.monotonic() if clock else 0.0) - 12.0, why, next_what, None if next_s is None else utc(NOON + next_s),
        "fast", **more,
    )  # fmt: skip


def _following(of, clock, **more):
    seen = looks(of, NOON, clock.monotonic())
    last, errors = seen[-1], [each.error_deg for each in seen]
    state = stand_in.at_rest(clock)
    position = replace(
        state.position, az_deg=last.reported_az_deg, el_deg=last.reported_el_deg, dish_az_deg=last.reported_az_deg,
        dish_el_deg=last.reported_el_deg,
    )  # fmt: skip
    rms = math.sqrt(sum(each * each for each in errors) / len(errors))
    state = replace(
        state, position=position, activity=Activity.FOLLOWING, holder="tracker", target_az_deg=last.target_az_deg,
        target_el_deg=last.target_el_deg,
        pursuit=pursuit(of, Phase.FOLLOWING, "On the target.", "ceiling", 60.0, clock,
                        latency_s=0.061, sample=last, rms_error_deg=rms, max_error_deg=max(errors)),
    )  # fmt: skip
    return state, desk(of, mode=Mode.FOLLOW, radio=TUNED, **more), seen


def following(clock):
    return _following(plan(minutes=-2.9), clock)


def days(clock):
    """By elements of two days: they are what matters."""
    return _following(plan("ISS (ZARYA)", 25544, -2.9, age_days=2.0), clock)


def old(clock):
    """By elements with an unknown error."""
    return _following(plan(minutes=-2.9, age_days=3228.0), clock)


def old_chosen(clock):
    return stand_in.at_rest(clock), desk(plan("METOP-B", 38771, 12, 10, 231, 62, 38, age_days=3228.0)), []


def heard_by_sdrpp(clock):
    state, now, seen = following(clock)
    return state, replace(now, radio=SDRPP), seen


def keyhole(clock):
    return _following(plan("SUOMI NPP", 37849, -4.6, 14, 160, 345, 64.0, keyhole=24.0), clock)


def followed_moon(clock):
    of = moon()
    state, now, _ = _following(of, clock)
    return state, replace(now, radio=RadioNow()), looks(of, NOON + 0.5, clock.monotonic())


def chosen_slot(clock):
    aim = PlanTarget("28.2°E Astra 28", "slot", skew=Skew(-13.96, 7.0))
    return stand_in.at_rest(clock), desk(replace(moon(), aim=aim)), []


SKEW = Skew(-13.96, 7.0)


def followed_geo(clock):
    """On a slot for five minutes: the dish stands still, and its tuner is read."""
    of = geo()
    of = replace(of, aim=replace(of.aim, skew=SKEW))
    state, now, _ = _following(of, clock)
    seen = [replace(each, at=each.at - 300.0, utc=each.utc) for each in looks(of, NOON + 300.0, clock.monotonic())]
    why = "On the target."
    followed = replace(state.pursuit, why=why, next_what="", next_at=None)
    return replace(state, pursuit=followed), replace(now, radio=RadioNow()), seen


ON_SLOT = ("craft-geo", "craft-geo-held")


def on_slot(clock):
    """What the tuner has heard in those five minutes: four readings every six seconds."""
    now = clock.monotonic()
    return [
        Heard(now - 300.0 + 6.0 * visit + 0.4 * read, 900.0 + 12.0 * math.sin(visit * 1.7 + read), 190.0, 40.0)
        for visit in range(50) for read in range(4)
    ]  # fmt: skip


def chosen_geo(clock):
    return stand_in.at_rest(clock), desk(geo("GEO 7", drift_deg=4.0, number=7)), []


def held_geo(clock):
    state, now, seen = followed_geo(clock)
    held = HeldState("you", clock.monotonic(), clock.utc(), HeldReason.STOP, None, None, None, 0)
    over = replace(state.pursuit, phase=Phase.OVER, why="Stopped by you.")
    return replace(state, activity=Activity.IDLE, pursuit=over, held=held), now, seen


def waiting_geo(clock):
    of = geo()
    waits = pursuit(of, Phase.COUNTDOWN, "The dish is about to move.", "follow", 4.4, clock)
    return replace(stand_in.at_rest(clock), holder="tracker", pursuit=waits), desk(of, mode=Mode.FOLLOW), []


def low_geo(clock):
    return stand_in.at_rest(clock), desk(geo("75.0°W", limit="below the 18° floor", el_deg=12.0)), []


def idle(clock):
    return stand_in.at_rest(clock), desk(None), []


def chosen(clock):
    return stand_in.at_rest(clock), desk(plan("ISS (ZARYA)", 25544, 12, 10, 231, 62, 38)), []


def waiting(clock):
    of = plan("METOP-C", 43689, 31, 14, 12, 190, 52, offset_s=0.3)
    state = replace(
        stand_in.at_rest(clock),
        holder="tracker",
        pursuit=pursuit(
            of,
            Phase.WAITING,
            "Below the 18° floor until 12:34:32; it moves at 12:32:10.",
            "pre-position",
            1930.0,
            clock,
        ),
    )
    return state, desk(of, mode=Mode.FOLLOW, autotrack=True), []


def countdown(clock):
    of = plan("METOP-C", 43689, -2.5, 14, 12, 190, 52)
    state = replace(
        stand_in.at_rest(clock),
        holder="tracker",
        pursuit=pursuit(
            of, Phase.COUNTDOWN, "It is about to go to where METOP-C comes into reach.", "pre-position", 4.4, clock
        ),
    )
    return state, desk(of, mode=Mode.FOLLOW), []


def interrupted(clock):
    state, now, seen = _following(plan(minutes=-2.9), clock)
    state = replace(
        state,
        activity=Activity.IDLE,
        pursuit=replace(
            state.pursuit,
            phase=Phase.INTERRUPTED,
            why="The link was lost for 12 s: f follows again.",
            next_what="",
            next_at=None,
        ),
    )
    return state, now, seen


def over(clock):
    state, now, seen = _following(plan(minutes=-13.9), clock)
    state = replace(
        state, activity=Activity.IDLE, holder=None, pursuit=replace(state.pursuit, phase=Phase.OVER, why="It has set.")
    )
    left = Unfinished("METEOR-M2 4", "59051", utc(NOON - 100), utc(NOON + 300))
    return state, replace(now, mode=Mode.WATCH, unfinished=left), seen


def held(clock):
    state, now, seen = _following(plan(minutes=-2.9), clock)
    state = replace(
        state,
        activity=Activity.IDLE,
        pursuit=replace(state.pursuit, phase=Phase.OVER, why="Stopped by you."),
        held=HeldState("you", clock.monotonic(), clock.utc(), HeldReason.STOP, None, None, None, 0),
    )
    return state, now, seen


SCENES = {
    "craft-idle": idle, "craft-chosen": chosen, "craft-waiting": waiting, "craft-countdown": countdown,
    "craft-following": following, "craft-days": days,
    "craft-old": old, "craft-old-chosen": old_chosen, "craft-keyhole": keyhole, "craft-moon": followed_moon,
    "craft-interrupted": interrupted, "craft-over": over, "craft-held": held,
    "craft-sdrpp": heard_by_sdrpp, "craft-slot": chosen_slot, "craft-geo": followed_geo, "craft-geo-held": held_geo,
    "craft-geo-chosen": chosen_geo, "craft-geo-low": low_geo, "craft-geo-countdown": waiting_geo,
}  # fmt: skip


class Source:
    """Shows what it is given, and notes what is asked of it."""

    made: list[Source] = []  # noqa: RUF012 - the last one, for the tests to look at

    def __init__(self, now):
        self.now, self.asked = now, []
        Source.made[:] = [self]  # one that is kept keeps its app

    def __call__(self, show):
        self.show = show
        return self

    def start(self):
        self.show(self.now)

    def keep(self, place, horizon=None, feed=""):
        self.place, self.horizon = place, horizon

    def search(self, text):
        self.asked.append(("search", text))
        found = tuple(one for one in FOUND if text.casefold() in one.name.casefold())
        self.now = replace(self.now, query=text, found=found)
        self.show(self.now)

    def locate(self, text):
        self.asked.append(("locate", text))

    def choose(self, text):
        self.asked.append(("choose", text))

    def choose_pass(self, aos):
        self.asked.append(("choose_pass", aos))

    def set_time_offset(self, seconds):
        self.asked.append(("set_time_offset", seconds))

    def set_frequency(self, hertz):
        self.asked.append(("set_frequency", hertz))

    def set_autotrack(self, on):
        self.asked.append(("set_autotrack", on))

    def watch(self):
        self.asked.append(("watch",))

    def aim_once(self):
        self.asked.append(("aim_once",))

    def follow(self):
        self.asked.append(("follow",))

    def leave(self):
        self.asked.append(("leave",))

    def take_up(self):
        self.asked.append(("take_up",))

    def resume(self):
        self.asked.append(("resume",))

    def forget_unfinished(self):
        self.asked.append(("forget_unfinished",))

    def close(self):
        self.closed = True


def desk_in(name, clock):
    """What the desk shows in one of the scenes."""
    return SCENES[name](clock)[1]


def app_in(name, **options):
    """The app in one of the scenes: state, desk and looks."""
    scene = SCENES[name]
    options.setdefault("sky", sky_stand_in.make())
    app = stand_in.app_in("idle", **options)
    clock = app.session.clock
    clock.advance(NOON - clock.utc().timestamp())
    state, now, seen = scene(clock)
    app.station.state = state
    app.track._make = Source(now)
    app.track.looks.extend(seen)
    if name in ON_SLOT:
        app.signals.book.of(TUNER_FACTS).clear()
        app.signals.book.of(TUNER_FACTS).extend(on_slot(clock))
    app.track._number = None if state.pursuit is None else state.pursuit.number
    return app


def change_to(app, name):
    """Let an app that runs show another scene, as if it had been in it from the start."""
    app.station.state, now, seen = SCENES[name](app.session.clock)
    app.signals.book.of(TUNER_FACTS).clear()
    app.signals.book.of(TUNER_FACTS).extend(on_slot(app.session.clock) if name in ON_SLOT else ())
    app.track._number = None if app.station.state.pursuit is None else app.station.state.pursuit.number
    app.track.looks.clear()
    app.track.looks.extend(seen)
    app.track.source.now = now
    app.track.source.show(now)
