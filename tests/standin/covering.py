"""Combinations of the stand-in's switches: a small array in which every two values of two switches meet."""

from __future__ import annotations

import itertools
import random

Row = dict[str, object]

HEALTHY: dict[str, tuple[Row, ...]] = {
    "eol": ({}, {"eol": "\n"}, {"eol": "\r"}, {"eol": "\n\r"}),
    "echo": ({}, {"echo": "lower"}, {"echo_while_busy": True}),
    "prompts": ({}, {"prompts": "spaced"}, {"colour": True}, {"prompts": "spaced", "colour": True}),
    "decimals": ({}, {"decimals": 0}, {"decimals": 1}, {"decimals": 4}),
    "latency": ({}, {"latency_s": 0.02, "jitter_s": 0.08}, {"latency_s": 0.05, "jitter_s": 0.4}, {"latency_s": 0.6}),
    "wire": ({}, {"wire_s": 0.1}, {"pieces": True}, {"half_duplex": True}),
    "chatter": ({}, {"chatter_s": 2.0}, {"chatter_in_reply": 0.3}, {"chatter_s": 0.3, "chatter_in_reply": 0.3}),
    "second": (
        {}, {"second_other": "block"}, {"second_same": "block", "second_other": "block"},
        {"second_same": "queue", "second_other": "queue"}, {"second_other": "refuse"}, {"second_other": "ignore"},
        {"second_same": "block"}, {"second_same": "abort", "second_other": "abort"},
        {"second_same": "refuse", "second_other": "refuse"}, {"query_blocks": True},
    ),
    "answer": ({}, {"move_answer": "empty"}, {"move_answer": "np"}, {"move_answer": "OK"}, {"takes_moves": False}),
    "root": ({}, {"root_q": "dies"}, {"root_q": "unknown", "unknown_text": "???"}, {"unknown_text": ""}),
    "sleep": ({}, {"sleep_s": 45.0}),
    "speed": ({}, {"az_speed": 12.0, "el_speed": 8.0}, {"az_speed": 30.0, "el_speed": 4.0, "accel": 60.0}),
    "homed": (
        {}, {}, {"homed": False}, {"homed": False, "unhomed_as": "hundredths"},
        {"homed": False, "unhomed_as": "negative"},
    ),
    "rest": ({}, {"overshoot_deg": 0.05}, {"tracker": True}, {"az_deg": 1.0, "el_deg": 18.0}),
}  # fmt: skip
"""What a G2 in good order may be like; the first of each is the tamest."""

STRANGE: dict[str, tuple[Row, ...]] = {
    "echo": ({}, {"echo": "off"}, {"echo": "upper"}),
    "prompts": ({}, *({"prompts": name} for name in ("lower", "none", "alike", "hash", "renamed"))),
    "loss": ({}, {"loss": 0.002}, {"loss": 0.02}),
    "answers": ({}, {"latency_s": 1.5}, {"latency_s": 4.0}, {"latency_s": 12.0}),
    "sleep": ({}, {"sleep_s": 30.0, "asleep": "late"}, {"sleep_s": 30.0, "asleep": "deaf"}),
    "turn": ({}, {"shows_turn": True}),
    "homed": ({}, {"homed": False, "unhomed_as": "nan"}, {"homed": False, "unhomed_as": "--"}),
    "baud": ({}, {"baud": 57600}),
    "texts": ({}, {"unknown_text": "Error 17"}, {"move_answer": "Angle = 12.00"}, {"busy_text": "MOT>"}),
}  # fmt: skip
"""What is out of order, or of another make: then nothing has to work, and nothing may be said that is not so."""


def pairwise(switches: dict[str, tuple[Row, ...]], seed: int = 1, tries: int = 60) -> list[Row]:
    """Return rows in which every two values of two switches meet: the best of some random rows, one by one."""
    rng = random.Random(seed)
    names = list(switches)
    open_pairs = {
        (one, i, two, j)
        for one, two in itertools.combinations(names, 2)
        for i in range(len(switches[one]))
        for j in range(len(switches[two]))
    }

    def pairs(choice: dict[str, int]) -> set[tuple[str, int, str, int]]:
        return {(one, choice[one], two, choice[two]) for one, two in itertools.combinations(names, 2)}

    rows = []
    while open_pairs:
        one, i, two, j = min(open_pairs)
        fixed = {one: i, two: j}
        drawn = [{name: rng.randrange(len(switches[name])) for name in names} | fixed for _ in range(tries)]
        best = max(drawn, key=lambda choice: len(pairs(choice) & open_pairs))
        open_pairs -= pairs(best)
        rows.append(merged(switches, best))
    rng.shuffle(rows)
    return rows


def singles(switches: dict[str, tuple[Row, ...]]) -> list[Row]:
    """Return each value alone, the rest tame."""
    return [{}, *(value for values in switches.values() for value in values if value)]


def drawn(switches: dict[str, tuple[Row, ...]], rng: random.Random) -> Row:
    """Return one row at random."""
    return merged(switches, {name: rng.randrange(len(values)) for name, values in switches.items()})


def merged(switches: dict[str, tuple[Row, ...]], choice: dict[str, int]) -> Row:
    row: Row = {}
    for name, index in choice.items():
        row |= switches[name][index]
    return row
