"""Ten thousand exchanges under random faults of the wire (`-m soak`), and a few hundred of the same at all times.

What must hold, exchange by exchange:

- What is read was printed by the dish in this very exchange: no reading is an older one's, another command's or made of
  two. There is one exception, which no single reading can tell: a byte *of the number itself* was lost, doubled or
  replaced between the dish and the program (of a row of the settings memory, any byte). Every reading that differs is
  held against what the wire did to it. What the station does about such a reading is tried in `test_day`.
- A menu that is told is the menu that the dish is in. No exception.
- A move that is told to be taken was taken once, to the hundredth; one that is not told so raised an error, or its
  answer counts as unsure; none is taken twice. There is one exception: both the line and its echo were altered.
- Every move that the dish heard reaches the motors, and at rest count and shaft stand where the last one led.
- On a clean line nothing fails, but for one exchange after each change of weather. The shell lives (`root_q=kill`).
"""

from __future__ import annotations

import pytest
from night import by_night

from .exchanges import KINDS, Exchanges


def soak(kind, seed, exchanges):
    run = Exchanges(KINDS[kind], seed)
    run.run(exchanges)
    assert not run.wrong, "\n".join([f"{kind}, seed {seed}", *run.wrong])
    return run.tally


@pytest.mark.parametrize("kind", KINDS)
def test_a_few_hundred_exchanges(kind):
    tally = soak(kind, 4, 600)
    assert tally["done"] > 300


@pytest.mark.soak
@pytest.mark.parametrize("seed", by_night([1, 2], 1))
@pytest.mark.parametrize("kind", KINDS)
def test_ten_thousand_exchanges(kind, seed):
    tally = soak(kind, seed, 10_000)
    failed = 10_000 - tally["done"]
    assert 1_000 < failed < 4_000, "the weather was bad enough, and no worse"
    assert min(tally["position"], tally["row"], tally["menu"], tally["move"], tally["order"]) > 500
    altered = sum(count for what, count in tally.items() if "altered on the wire" in what)
    assert altered < 0.02 * tally["done"], "what no single reading can tell is rare"
