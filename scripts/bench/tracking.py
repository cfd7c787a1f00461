"""How well a dish follows: real passes, our own simulator at the byte level through the real driver, a virtual clock.

Peers run as policies on the same passes: Gpredict's at 5 and 1 degree, and a move to where the target is now once a
second, each with and without leapfrog, and as clients of a server that smooths their wishes,
or recognises what they follow. Base case and second row
are in `tracking_dishes.py`; perfect elements and clock. Errors are angles on the sky against the simulator's true
direction at 20 Hz, while the target is between floor and ceiling.
The last line is one JSON object. `--quick` runs a tenth of the passes.
The Carryout of 2003 is driven by the whole station, and held against its own forecast. The last table has a row for
each machine that is simulated, beside Gpredict's policies and what it leaves to any driver (`tracking_machines.py`).
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
from collections.abc import Callable, Iterable, Sequence
from multiprocessing import Pool

from tracking_dishes import G2, TRAVLER_5
from tracking_machines import machine_rows
from tracking_passes import everything, named, spread
from tracking_peers import PEERS
from tracking_recognised import RECOGNISED
from tracking_smoothed import SMOOTHED
from tracking_station import by_time
from tracking_work import Score, Work, run

PASSES = 60
LATE_S = 1.0
BUDGET = {
    "g2_median_rms_deg": 0.02, "g2_worst_rms_deg": 0.05, "g2_max_error_deg": 0.15, "g2_second_row_median_rms_deg": 0.06,
    "g2_velocity_matched_median_rms_deg": 0.005, "travler5_median_rms_deg": 0.09, "travler5_off_keyhole_rms_deg": 0.12,
    "keyhole_ratio_to_limit": 2.6, "unplanned_rewinds": 0, "largest_backlog": 1, "time_within_1db_below_limit": 0.005,
    "robust_median_rms_deg": 0.07, "robust_ratio": 1.3, "robust_play_ratio_to_saw_tooth": 1.3,
    "clock_wrong_restored_ratio": 1.2, "velocity_lost_ratio_to_stepping": 1.15,
    "untold_median_rms_deg": 0.15, "untold_no_records_median_rms_deg": 0.3, "untold_ratio_to_forecast": 1.0,
    "untold_max_ratio_to_forecast": 1.0,
}  # fmt: skip
KNOWN_TO_MISS = frozenset({"g2", "g2plus?overshoot=0"})
"""Machines whose row misses its goal, as `docs/tracking.md` says."""
AT_LEAST = {"times_better_than_move_to_now": 10.0, "times_better_than_gpredict5": 100.0}
HEAD = f"{'':34}{'median':>8}{'worst':>8}{'median':>8}{'worst':>8}{'within':>9}{'of':>9}{'commands':>10}"
HEAD2 = f"{'':34}{'rms':>8}{'rms':>8}{'max':>8}{'max':>8}{'0.58°':>9}{'possible':>9}{'a second':>10}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="a tenth of the passes")
    quick = parser.parse_args().quick
    cases = everything()
    hard = named(cases, lambda case: all(dish.turn(case) is not None for dish in (G2, TRAVLER_5)), 18.0, 65.0)
    count = PASSES // 10 if quick else PASSES
    g2 = spread([case for case in cases if G2.turn(case) is not None], count)
    travler = spread([case for case in cases if TRAVLER_5.turn(case) is not None], count)
    some = g2[:: 1 if quick else 5]
    groups: dict[str, list[Work]] = {
        "g2": [Work(case, G2.name, "fast") for case in g2],
        "g2 hard": [Work(case, G2.name, "fast") for case in hard],
        "g2 velocity": [Work(case, G2.name, "velocity matched") for case in g2],
        "g2 worn": [Work(case, G2.name, "fast", "worn") for case in g2],
        "g2 worn velocity": [Work(case, G2.name, "velocity matched", "worn") for case in some],
        "travler": [Work(case, TRAVLER_5.name, "queued") for case in travler],
        "travler hard": [Work(case, TRAVLER_5.name, "queued") for case in hard],
        "g2 lost": [Work(case, G2.name, "fast", "lost") for case in some],
        "g2 lost velocity": [Work(case, G2.name, "velocity matched", "lost") for case in some],
        "g2 some": [Work(case, G2.name, "fast") for case in some],
        "g2 shaken": [Work(case, G2.name, "fast", "shaken") for case in g2],
        "g2 shaken known": [Work(case, G2.name, "fast", "shaken", gear_known=True) for case in g2],
        "g2 robust": [Work(case, G2.name, "fast", "robust") for case in g2],
        "g2 robust known": [Work(case, G2.name, "fast", "robust", gear_known=True) for case in g2],
        "g2 play": [Work(case, G2.name, "fast", "play") for case in some],
        "g2 play known": [Work(case, G2.name, "fast", "play", gear_known=True) for case in some],
        "g2 late": [Work(case, G2.name, "fast", late_s=LATE_S) for case in some],
        "g2 late mended": [Work(case, G2.name, "fast", late_s=LATE_S, offset_s=-LATE_S) for case in some],
    }
    for name in PEERS:
        groups[f"g2 {name}"] = [Work(case, G2.name, name) for case in g2]
        groups[f"g2 worn {name}"] = [Work(case, G2.name, name, "worn") for case in some]
        groups[f"travler {name}"] = [Work(case, TRAVLER_5.name, name) for case in travler]
        groups[f"travler hard {name}"] = [Work(case, TRAVLER_5.name, name) for case in hard]
    groups |= {f"g2 {name}": [Work(case, G2.name, name) for case in g2] for name in (*SMOOTHED, *RECOGNISED)}
    scores = _run_all(groups)
    _print_all(scores, len(g2))
    with Pool(min(os.cpu_count() or 1, 4)) as pool:
        report = _report(scores) | by_time(spread(cases, max(2, count // 5)), pool)
        machines, goals_missed = machine_rows(spread(cases, max(2, count // 10)), pool)
    print(
        json.dumps(
            {"bench": "tracking", "passes": len(g2), **report, "machines": machines, "budget": {**BUDGET, **AT_LEAST}}
        )
    )
    missed = [name for name, most in BUDGET.items() if report[name] > most]
    missed += [name for name, least in AT_LEAST.items() if report[name] < least]
    missed += [f"goal of {name}" for name in goals_missed if name not in KNOWN_TO_MISS]
    sys.exit(f"outside the budget: {', '.join(missed)}" if missed else 0)


def _run_all(groups: dict[str, list[Work]]) -> dict[str, list[Score]]:
    works = list(dict.fromkeys(work for group in groups.values() for work in group))
    with Pool(min(os.cpu_count() or 1, 4)) as pool:
        found: dict[Work, Score] = {}
        for work, score in zip(works, pool.imap(run, works, chunksize=1), strict=True):
            found[work] = score
            print(f"{len(found)} of {len(works)}", end="\r", file=sys.stderr, flush=True)
    return {name: [found[work] for work in group] for name, group in groups.items()}


def _median(values: Iterable[float]) -> float:
    return statistics.median(list(values))


def _row(name: str, scores: Sequence[Score], rms: Callable[[Score], float] = lambda score: score.rms) -> None:
    rate = sum(score.commands for score in scores) / sum(score.seconds for score in scores)
    print(
        f"{name:34}{_median(map(rms, scores)):8.3f}{max(map(rms, scores)):8.3f}"
        f"{_median(score.worst for score in scores):8.2f}{max(score.worst for score in scores):8.2f}"
        f"{_mean(score.close for score in scores):9.2%}{_mean(score.close_limit for score in scores):9.2%}{rate:10.1f}"
    )


def _with_floors(name: str, scores: Sequence[Score]) -> None:
    """Print a row, and what the commands leave of it at the instants at which they acted (`Score`)."""
    _row(name, scores)
    for floor, rms in (
        ("  saw-tooth of its commands", [score.saw_tooth for score in scores]),
        ("  and of instants not foreseen", [score.unforeseen for score in scores]),
    ):
        print(f"{floor:34}{_median(rms):8.3f}{max(rms):8.3f}")


def _mean(values: Iterable[float]) -> float:
    return statistics.fmean(list(values))


def _print_all(scores: dict[str, list[Score]], passes: int) -> None:
    print(f"Degrees on the sky, {passes} passes a dish.\n")
    print(f"Carryout G2, base case\n{HEAD}\n{HEAD2}")
    _row("birdcage, fast", scores["g2"])
    _row("birdcage, velocity matched", scores["g2 velocity"])
    for name in sorted((*PEERS, *SMOOTHED, *RECOGNISED)):
        _row(name, scores[f"g2 {name}"])
    print("\nCarryout G2, second row: overshoot 0.01 to 0.06°, backlash 0.06° (all but the first: every fifth pass)")
    _row("birdcage, fast", scores["g2 worn"])
    _row("birdcage, velocity matched", scores["g2 worn velocity"])
    for name in PEERS:
        _row(name, scores[f"g2 worn {name}"])
    print("\nTrav'ler at 5°/s and 20°/s², base case")
    _row("birdcage, queued", scores["travler"])
    _row("birdcage, off the keyhole", scores["travler"], lambda score: score.off_keyhole_rms)
    for name in PEERS:
        _row(name, scores[f"travler {name}"])
    print(f"\nHard passes{'':23}{'rms':>8}{'max':>8}{'off the keyhole':>17}{'least max':>11}{'rewinds':>9}")
    for group in ("g2 hard", "travler hard", "travler hard Gpredict, 5°", "travler hard move to now, 1 Hz"):
        for score in scores[group]:
            print(
                f"{score.work.dish[:8] + ', ' + score.work.policy[:12] + ', ' + score.work.case.label:34.34}"
                f"{score.rms:8.3f}{score.worst:8.2f}{score.off_keyhole_rms:17.3f}{score.hole_limit:11.2f}"
                f"{score.planned_rewinds:9}"
            )
    print(f"\nRobust, Carryout G2, every fifth pass\n{HEAD}\n{HEAD2}")
    _row("base case", scores["g2 some"])
    _row("0.06° play", scores["g2 play"])
    _row("  known", scores["g2 play known"])
    _row("2 % of the replies lost", scores["g2 lost"])
    _row("  velocity matched", scores["g2 lost velocity"])
    _row("clock 1 s behind", scores["g2 late"])
    _row("  with a time offset of -1 s", scores["g2 late mended"])
    print(f"\nRobust, Carryout G2, 200 ms of jitter, 2 % of the replies lost, 0.06° play, all passes\n{HEAD}\n{HEAD2}")
    _with_floors("play not known", scores["g2 shaken"])
    _with_floors("play known", scores["g2 shaken known"])
    print("And an overshoot of 0.01 to 0.06°")
    _with_floors("gear not known", scores["g2 robust"])
    _with_floors("gear known", scores["g2 robust known"])
    print()


def _report(scores: dict[str, list[Score]]) -> dict[str, float]:
    def median(name: str) -> float:
        return _median(score.rms for score in scores[name])

    ours = [
        score
        for name in (
            "g2",
            "g2 hard",
            "g2 velocity",
            "travler",
            "travler hard",
            "g2 worn",
            "g2 shaken",
            "g2 shaken known",
            "g2 robust known",
            "g2 lost velocity",
        )
        for score in scores[name]
    ]
    both = scores["g2"] + scores["travler"]
    holes = [
        score.hole_worst / score.hole_limit for score in scores["travler"] + scores["travler hard"] if score.hole_limit
    ]
    report = {
        "g2_median_rms_deg": median("g2"),
        "g2_worst_rms_deg": max(score.rms for score in scores["g2"]),
        "g2_max_error_deg": max(score.worst for score in scores["g2"]),
        "g2_velocity_matched_median_rms_deg": median("g2 velocity"),
        "g2_second_row_median_rms_deg": median("g2 worn"),
        "travler5_median_rms_deg": median("travler"),
        "travler5_off_keyhole_rms_deg": max(score.off_keyhole_rms for score in scores["travler"]),
        "keyhole_ratio_to_limit": max(holes),
        "unplanned_rewinds": sum(score.astray for score in ours),
        "largest_backlog": max(score.backlog for score in ours),
        "time_within_1db_below_limit": _mean(score.close_limit - score.close for score in both),
        "gpredict5_median_rms_deg": median("g2 Gpredict, 5°"),
        "gpredict1_median_rms_deg": median("g2 Gpredict, 1°"),
        "gpredict5_recognised_median_rms_deg": median("g2 Gpredict, 5°, recognised"),
        "gpredict1_recognised_median_rms_deg": median("g2 Gpredict, 1°, recognised"),
        "move_to_now_median_rms_deg": median("g2 move to now, 1 Hz"),
        "robust_median_rms_deg": median("g2 robust known"),
        "robust_ratio": _median(score.rms / score.unforeseen for score in scores["g2 robust known"]),
        "robust_ratio_to_saw_tooth": _median(score.rms / score.saw_tooth for score in scores["g2 robust known"]),
        "robust_play_median_rms_deg": median("g2 shaken known"),
        "robust_play_ratio_to_saw_tooth": _median(score.rms / score.saw_tooth for score in scores["g2 shaken known"]),
        "velocity_lost_median_rms_deg": median("g2 lost velocity"),
        "velocity_lost_ratio_to_stepping": max(
            matched.rms / stepped.rms
            for matched, stepped in zip(scores["g2 lost velocity"], scores["g2 lost"], strict=True)
        ),
        "clock_wrong_median_rms_deg": median("g2 late"),
        "clock_wrong_restored_ratio": median("g2 late mended") / median("g2 some"),
    }
    report["times_better_than_move_to_now"] = report["move_to_now_median_rms_deg"] / report["g2_median_rms_deg"]
    report["times_better_than_gpredict5"] = report["gpredict5_median_rms_deg"] / report["g2_median_rms_deg"]
    return {name: round(value, 4) for name, value in report.items()}


if __name__ == "__main__":
    main()
