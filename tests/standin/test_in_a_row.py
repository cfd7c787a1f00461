"""One program after the other: what the one before has left under way answers nothing of the next one's."""

from __future__ import annotations

import pytest

EARLY = {"echo_while_busy": True, "az_deg": 1.0, "el_deg": 18.0}
"""What is typed is echoed while the shell still works on the line before: an echo then proves nothing."""
WORK = (
    ("init",),
    ("home", "--yes"),
    ("pos",),
    ("status",),
    ("move", "--az", "50", "--el", "30"),
    ("pos",),
)


@pytest.mark.parametrize(("latency_s", "jitter_s"), [(0.6, 0.0), (0.02, 0.08), (0.05, 0.4)])
@pytest.mark.parametrize("killed", [False, True], ids=["closed", "killed"])
def test_each_command_hears_its_own_answers(terminal, latency_s, jitter_s, killed):
    hand = terminal(latency_s=latency_s, jitter_s=jitter_s, **EARLY)
    for words in WORK:
        said = hand.run(*words)
        assert said.code == 0, said
        if killed:
            hand.dish.hear(b"\r")
    assert hand.dish.where() == (pytest.approx(50.0), pytest.approx(30.0))
    assert said.out.split() == ["AZ:", "50.0", "EL:", "30.0"]
    assert hand.dish.root_q == 0
