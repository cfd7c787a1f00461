"""The plain parts of the page of passes: moments, choice, words; nothing is drawn here."""

import pytest
import sky_stand_in
from birdcage_tui.passes.choose import SORTS, PassFilter, matcher
from birdcage_tui.passes.machine import SPEEDS, TimeMachine
from birdcage_tui.passes.passes_layout import VIEWS, layout
from birdcage_tui.shown.pass_words import count_text, length_text, reach_sign, reasons_text, shift_text
from birdcage_tui.shown.sky_picture import Path

T, in_reach = sky_stand_in.NOON, sky_stand_in.in_reach
ROWS = sky_stand_in.rows()


def row(*intervals, lost=(), aos=T + 600, los=T + 1200, **more):
    reach = in_reach(*intervals, lost=lost, best=40.0 if intervals else None)
    times_s = (aos, (aos + los) / 2, los)
    return sky_stand_in.shown_pass("SAT", 1, times_s, (10.0, 90.0, 170.0), 40.0, reach=reach, **more)


def test_a_countdown_counts_to_reach_where_there_is_any_and_says_so():
    one = row((T + 700, T + 800), (T + 900, T + 1100))
    assert [one.next_event(T + at) for at in (0, 650, 750, 850, 950, 1150, 1300)] == [
        (T + 700, "reach"), (T + 700, "reach"), (T + 800, "out"), (T + 900, "reach"), (T + 1100, "out"),
        (T + 1200, "LOS"), None,
    ]  # fmt: skip
    never = row()
    assert [never.next_event(T + at) for at in (0, 700)] == [(T + 600, "AOS"), (T + 1200, "LOS")]
    assert row(already_up=True).next_event(T) == (T + 1200, "LOS"), "nobody saw it rise"


def test_a_path_goes_the_short_way_over_north():
    path = Path((0.0, 10.0), (350.0, 20.0), (10.0, 30.0))
    assert path.at(5.0) == pytest.approx((5.0, 20.0))
    assert path.at(10.0) == pytest.approx((20.0, 30.0))
    assert path.at(10.1) is None
    assert path.at(-0.1) is None


def test_a_pass_without_losses_but_at_its_ends_is_told_so():
    ends = ((0, 60, "floor"), (500, 600, "horizon"))
    assert reach_sign(in_reach((60, 500), lost=ends, best=40.0)) == ("●", "good", "")
    cut = in_reach((60, 200), (260, 500), lost=(*ends, (200, 260, "keyhole")), best=60.0)
    assert reach_sign(cut) == ("◍", "good", "keyhole")
    trees = in_reach((60, 200), (260, 500), lost=((200, 260, "horizon"),), best=60.0)
    assert reach_sign(trees) == ("◍", "good", "horizon"), "a hole in the middle is one, whatever makes it"
    assert reach_sign(in_reach(lost=((0, 600, "floor"),))) == ("○", "dim", "floor")


def test_reasons_are_told_by_what_they_cost():
    reach = in_reach(lost=((0, 10, "floor"), (10, 50, "cable"), (50, 60, "floor")))
    assert reach_sign(reach) == ("○", "dim", "cable, floor")


@pytest.mark.parametrize(
    ("span_s", "words"), [(0, "00:00"), (200, "03:20"), (3599, "59:59"), (3600, "1h00"), (90000, "1d1h")]
)
def test_countdowns_fit_their_column(span_s, words):
    assert count_text(span_s) == words
    assert len(words) <= 6


@pytest.mark.parametrize(
    ("span_s", "words"),
    [(0.4, "0s"), (59.4, "59s"), (59.6, "1m00"), (485, "8m05"), (599.6, "10m"), (3300, "55m"), (3599, "1h00"),
     (86400, "24h00")],
)  # fmt: skip
def test_lengths_fit_their_column(span_s, words):
    assert length_text(span_s) == words
    assert len(words) <= 5


def test_how_far_from_now_is_told_in_words():
    assert shift_text(40) == "40 s ahead"
    assert shift_text(-90) == "1 min 30 s back"
    assert shift_text(4320) == "1 h 12 min ahead"


# The time machine.


def test_the_machine_shows_now_until_it_is_told_otherwise_and_one_call_leads_back():
    machine = TimeMachine()
    assert machine.time(T) == T
    assert machine.is_now
    machine.shift(T, 60.0)
    assert machine.time(T) == T + 60
    assert machine.time(T + 10) == T + 70, "it goes on at the pace of the clock"
    assert not machine.is_now
    machine.back_to_now()
    assert (machine.is_now, machine.time(T + 10), machine.speed) == (True, T + 10, 1)


def test_the_machine_pauses_and_runs_faster_without_a_jump():
    machine = TimeMachine()
    machine.pause(T)
    assert machine.time(T + 100) == T
    assert not machine.runs
    machine.faster(T + 100, 1)
    assert machine.runs, "a faster time is no paused one"
    assert machine.time(T + 100) == T
    assert machine.time(T + 101) == T + SPEEDS[1]
    for _ in range(10):
        machine.faster(T + 101, 1)
    assert machine.speed == SPEEDS[-1]
    assert machine.time(T + 101) == T + SPEEDS[1]


def test_the_machine_stays_where_passes_are_known():
    machine = TimeMachine()
    machine.bounds = (T - 100, T + 3600)
    machine.shift(T, 1e6)
    assert machine.time(T) == T + 3600
    machine.shift(T, -1e7)
    assert machine.time(T) == T - 100


# Which passes.


@pytest.mark.parametrize(
    ("typed", "names"),
    [
        ("metop", {"METOP-C"}),
        ("meteorm2", {"METEOR-M2 4", "METEOR-M2 3"}),
        ("noaa 20", {"NOAA 20 (JPSS-1)"}),
        ("57166", {"METEOR-M2 3"}),
        ("  ISS", {"ISS (ZARYA)"}),
        ("stations", {"ISS (ZARYA)"}),
        ("weather met", {"METEOR-M2 4", "METEOR-M2 3", "METOP-C"}),
        ("zzz", set()),
    ],
)
def test_the_filter_looks_at_names_numbers_and_groups(typed, names):
    meant = matcher(typed)
    assert {each.name for each in ROWS if meant(each)} == names


def test_orders():
    choice = PassFilter()
    events = [each.next_event(T)[0] for each in choice.of(ROWS, T)]
    assert events == sorted(events)
    found = {}
    for _ in SORTS[1:]:
        name = choice.next_sort()
        found[name] = choice.of(ROWS, T)
    reach = [each.reach_s for each in found["minutes in reach"]]
    assert reach == sorted(reach, reverse=True)
    assert found["highest"][0].max_el_deg == 88.0
    rise = [each.aos_s for each in found["AOS"]]
    assert rise == sorted(rise)
    assert choice.next_sort() == SORTS[0]


def test_what_is_over_goes_and_what_cannot_be_reached_can_be_hidden():
    choice = PassFilter()
    assert len(choice.of(ROWS, T)) == len(ROWS)
    later = choice.of(ROWS, T + 1800)
    assert all(each.los_s > T + 1800 for each in later)
    assert len(later) < len(ROWS)
    choice.reachable_only = True
    assert all(each.reach_s > 0 for each in choice.of(ROWS, T))
    choice.favourites_only = True
    assert {each.name for each in choice.of(ROWS, T)} == {"METEOR-M2 4", "ISS (ZARYA)", "METOP-C", "METEOR-M2 3"}


@pytest.mark.parametrize("size", [(80, 20), (100, 30), (120, 33), (160, 45), (200, 57)])
@pytest.mark.parametrize("shown", VIEWS)
def test_every_layout_fills_its_page(size, shown):
    width, height = size
    found = layout(width, height, shown)
    side = found.plot_height + found.strip_height + found.figures_height
    if found.plot_height:
        assert side == found.list_height
        assert found.list_width < width - 25
        upper = found.list_height
    else:
        upper = found.list_height + found.strip_height + found.figures_height
    assert 1 + upper + found.timeline_height == height


@pytest.mark.parametrize(
    ("width", "words"), [(21, "ceiling, cable, floor"), (20, "ceiling +2"), (10, "ceiling +2"), (9, "")]
)
def test_no_reason_is_cut(width, words):
    assert reasons_text("ceiling, cable, floor", width) == words
