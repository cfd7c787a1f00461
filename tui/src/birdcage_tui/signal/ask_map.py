"""Asks for a map of the sky: region, step, order, time, reference; tells how much that is before it begins."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import lru_cache

from birdcage.skymap.map_request import MapEstimate, MapRequest, estimate, usual_step_deg, within_reach
from birdcage.skymap.map_times import typed_times
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan

from birdcage_tui.shown.level_words import way_to
from birdcage_tui.shown.map_words import clock_words
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import View
from birdcage_tui.signal.map_marks import slots_over
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

WORDS = "The dish moves through the region by itself, and stops in each direction to listen. Keep clear of it."
SPARE_DEG = 5.0
"""Around the arc, in the region that is offered."""
AROUND_DEG, MOST_BESIDE_DEG, SIDE_DEG = 5.0, 30.0, 30.0
"""To each side of a target that moves, at most there, and of where the dish points where no place is known."""
MOST_COUNTED = 2500
"""Directions whose ways are added up one by one as a person types; more are estimated by their share."""
YES, NO = ("yes", "y"), ("no", "n", "")
REFERENCES = "none, peak, or az el of a strong source"
EDGE = 1e-9


@dataclass(frozen=True, slots=True)
class MapTyped:
    """The lines of the dialog, in their order."""

    azimuth: str
    elevation: str
    step: str
    order: str
    around: str
    start: str
    until: str
    reference: str
    details: str
    quiet: str


def map_question(look: Callable[[], View]) -> FieldsScreen:
    """Return what is asked before; `look` returns what holds as it is called, so that its times are of now."""
    view = look()
    az, el = usual_region(view)
    rows = (
        FieldRow("azimuth", az, "from:to in degrees, 350:10 goes over north. Around a target: right of it, -5:5"),
        FieldRow("elevation", el, "from:to in degrees. Around a target: above it, -5:5"),
        FieldRow("step, degrees", f"{usual_step_deg(view.state):g}", "between two directions: a third of the beam"),
        FieldRow("order", MapOrder.COARSE.value, "coarse to fine, rows, columns or spiral"),
        FieldRow("around", "", "sun, moon or a name. Empty: a fixed region"),
        FieldRow("start", "", "23:00 in UTC. Empty: now"),
        FieldRow("until", "", "05:30 in UTC. Empty: until it is complete"),
        FieldRow("reference", "none", f"{REFERENCES}. Each hour it shows drift and lost steps"),
        FieldRow("SNR and lock", "no", "yes: read in each direction too (slower)"),
        FieldRow("quiet", "no", "yes: the dish turns slowly"),
    )  # fmt: skip

    def check(values: Values) -> str:
        try:
            request_of(look(), values)
        except ValueError as wrong:
            return str(wrong)
        return ""

    @lru_cache(maxsize=1)  # each field tells the same lines as the dialog opens
    def read_at(values: Values, _minute: float) -> str:
        return told(look(), values)

    def read(values: Values) -> str:
        return read_at(values, look().utc.timestamp() // 60.0)

    return FieldsScreen("Map the sky", WORDS, rows, check, read=read, enter="Enter begins")


def usual_region(view: View) -> tuple[str, str]:
    """Return azimuth and elevation as they are typed: the arc, as far as the dish reaches, else around here."""
    low = view.state.el_min_deg if view.state.el_min_deg is not None else 10.0
    high = view.state.el_max_deg if view.state.el_max_deg is not None else 80.0
    here = 180.0 if view.state.position is None else view.state.position.az_deg
    place = view.settings.place
    seen = [] if place is None else [each for each in slots_over(place) if low <= each.el_deg <= high]
    if place is None or not seen:
        left, right = _down(here - SIDE_DEG), _up(here + SIDE_DEG)
        return f"{left:g}:{right:g}", f"{math.ceil(low):g}:{math.floor(high):g}"
    north = 0.0 if place.latitude_deg >= 0.0 else 180.0  # azimuths of the arc run on through north in the south
    azimuths = [(each.az_deg + north) % 360.0 - north for each in seen]
    left, right = _down(min(azimuths) - SPARE_DEG), _up(max(azimuths) + SPARE_DEG)
    top = min(_up(max(each.el_deg for each in seen) + SPARE_DEG / 2.0), math.floor(high))
    return f"{left:g}:{right:g}", f"{math.ceil(low):g}:{top:g}"


def _down(deg: float) -> float:
    return math.floor(deg / 5.0) * 5.0


def _up(deg: float) -> float:
    return math.ceil(deg / 5.0) * 5.0


def request_of(view: View, values: Values) -> MapRequest:
    """Return the map that is asked for, without the path of its target. ValueError says what to type instead."""
    typed = MapTyped(*values)
    around = " ".join(typed.around.split())
    frame = MapFrame.TARGET if around else MapFrame.AZEL
    (x_low, x_high), (y_low, y_high) = _span("Azimuth", typed.azimuth), _span("Elevation", typed.elevation)
    if x_high < x_low and not around:
        x_high += 360.0  # over north: 350:10
    order = typed.order.strip().lower()
    if order not in list(MapOrder):
        raise ValueError(f"Order is {order!r}. Type coarse, rows, columns or spiral.")
    if around and max(map(abs, (x_low, x_high, y_low, y_high))) > MOST_BESIDE_DEG:
        raise ValueError(f"Around a target both spans are degrees beside it. Type -{AROUND_DEG:g}:{AROUND_DEG:g}.")
    if around and view.settings.place is None:
        raise ValueError(NO_LOCATION)
    step_deg = _number("Step", typed.step, "Type degrees: 0.8.")
    plan = within_reach(MapPlan(x_low, x_high, y_low, y_high, step_deg, MapOrder(order), frame), view.state)
    start_s, until_s = typed_times(typed.start, typed.until, view.utc.timestamp())
    return MapRequest(
        plan, target=around, source=view.heard.id, details=_is_yes("SNR and lock", typed.details), start_s=start_s,
        until_s=until_s, reference=_reference(view, typed.reference), quiet=_is_yes("Quiet", typed.quiet),
    )  # fmt: skip


def told(view: View, values: Values) -> str:
    """Return how much is asked for, as far as it can be understood; nothing while it can't."""
    try:
        request = request_of(view, values)
    except ValueError:
        return ""
    much = estimated(view, request)
    now_s = view.utc.timestamp()
    begin_s = request.start_s or now_s
    ends_s = begin_s + much.seconds
    begins = f"begins {_clock(request.start_s, now_s)}, " if request.start_s else ""
    words = f"{much.words}, {begins}ends {_clock(ends_s, now_s)}."
    if request.until_s and ends_s > request.until_s:
        part = (request.until_s - begin_s) / much.seconds
        words += f" At {_clock(request.until_s, now_s)} it pauses: {part:.0%} is heard then."
    low, high = _span("Elevation", MapTyped(*values).elevation)
    plan = request.plan
    cut = plan.y_low_deg > low + EDGE or high - plan.y_high_deg > plan.row_step_deg
    if plan.frame is MapFrame.AZEL and cut:
        words += f" In reach: elevation {plan.y_low_deg:g} to {plan.y_high_deg:g}°."
    return words


def estimated(view: View, request: MapRequest, heard: frozenset[int] = frozenset()) -> MapEstimate:
    """Return how much a map is; of a large one the ways of a part are added up, and stand for all."""
    dwell_s = None if view.heard.of_dish else view.heard.dwell_s or 1.0 / max(view.heard.rate_hz, 0.1)
    plan = request.plan
    if plan.cells <= MOST_COUNTED:
        return estimate(request, view.state, dwell_s=dwell_s, heard=heard)
    rows = max(MOST_COUNTED // plan.columns, 1)
    columns = min(plan.columns, MOST_COUNTED)
    part = replace(plan, y_high_deg=plan.y_low_deg + (rows - 1) * plan.row_step_deg,
                   x_high_deg=plan.x_low_deg + (columns - 1) * plan.step_deg)  # fmt: skip
    left = plan.cells - len(heard)
    much = estimate(replace(request, plan=part), view.state, dwell_s=dwell_s)
    return MapEstimate(left, much.seconds * left / part.cells)


def _span(what: str, text: str) -> tuple[float, float]:
    low, _, high = text.replace("°", "").strip().partition(":")
    try:
        found = float(low), float(high)
    except ValueError:
        raise ValueError(f"{what} is {text.strip() or 'empty'!r}. Type from:to in degrees, 160:220.") from None
    if not all(map(math.isfinite, found)):
        raise ValueError(f"{what} is {text.strip()!r}. Type from:to in degrees, 160:220.")
    return found


def _number(what: str, text: str, instead: str) -> float:
    try:
        number = float(text.replace("°", "").strip())
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{what} is {text.strip() or 'empty'!r}. {instead}")
    return number


def _is_yes(what: str, text: str) -> bool:
    word = text.strip().lower()
    if word not in (*YES, *NO):
        raise ValueError(f"{what} is {word!r}. Type yes or no.")
    return word in YES


def _reference(view: View, text: str) -> tuple[float, float] | None:
    word = text.strip().lower()
    if word in ("", "none"):
        return None
    if word == "peak":
        to = None if view.level is None else way_to(view.level)
        if to is None:
            raise ValueError("No peak with a direction was heard yet. f finds one; or type az el.")
        return to
    try:
        az_deg, el_deg = (float(each) for each in word.replace("°", "").replace("/", " ").split())
    except ValueError:
        raise ValueError(f"Reference is {word!r}. Type {REFERENCES}.") from None
    if not (abs(az_deg) <= 720.0 and 0.0 <= el_deg <= 90.0):
        raise ValueError(f"Reference is {word!r}. Type azimuth, and elevation from 0 to 90.")
    return az_deg, el_deg


def _clock(at_s: float, now_s: float) -> str:
    return clock_words(datetime.fromtimestamp(at_s, UTC), datetime.fromtimestamp(now_s, UTC))


def target_path(
    text: str, place: SitePlace, begin_s: float, length_s: float
) -> tuple[str, tuple[tuple[float, ...], ...]]:
    """Return a target's name and where it stands from a time on. ValueError says why there is no map around it.

    It may take a second, as an ephemeris is read: never on the app's thread.
    """
    from birdcage.signal.source_path import seen_path, sun_path
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Resolver

    observer = Observer(place.latitude_deg, place.longitude_deg)
    if text.strip().lower() == "sun":
        name, path = "Sun", sun_path(observer, begin_s, length_s)
    else:
        found = Resolver().resolve(text)
        if found.found is None:
            raise ValueError(found.problem)
        name, path = found.target.name, seen_path(found.target, observer, "radio", begin_s, length_s)
    if path.at(begin_s)[1] < 0.0:
        raise ValueError(f"{name} is below the horizon at {_clock(begin_s, begin_s)}. Type a later start.")
    return name, tuple(tuple(row) for row in path.rows)
