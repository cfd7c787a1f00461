"""Which lines are a pursuit's own steps: asked as each goes out, and never said of STOP or of anybody else's motion."""

from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import AcquireLease, Jog, Pursue

from .pursuit_bench import at, g2, plan_of


def following():
    """A dish that follows, and each line that goes out from then on with whether it was a pursuit's."""
    bench, sent = g2(), []
    bench.station.submit(Pursue(plan_of(at(bench) + 5.0), "tracker"))
    bench.step(30.0)
    assert bench.state.pursuit.phase is Phase.FOLLOWING

    write = bench.sim.write

    def writing(data):
        sent.append((bytes(data).strip(), bench.station.is_steering()))
        write(data)

    bench.sim.write = writing
    return bench, sent


def moves(sent):
    return [(line, own) for line, own in sent if line.startswith((b"a 0 ", b"a 1 "))]


def test_the_steps_of_a_pursuit_are_its_own():
    bench, sent = following()
    bench.step(5.0)
    assert len(moves(sent)) > 10
    assert all(own for _, own in moves(sent))


def test_what_stop_sends_is_never_a_step():
    bench, sent = following()
    bench.station.stop("you")
    bench.step(5.0)
    assert moves(sent), "STOP retargets"
    assert not any(own for _, own in moves(sent))


def test_what_a_person_moves_is_never_a_step():
    bench, sent = following()
    bench.station.submit(AcquireLease("you", take_over=True))
    bench.station.submit(Jog(1.0, 0.0, "you"))
    bench.step(3.0)
    by_hand = next(index for index, (_, own) in enumerate(sent) if not own)
    assert moves(sent[by_hand:])
    assert not any(own for _, own in sent[by_hand:])
