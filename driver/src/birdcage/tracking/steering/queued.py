"""Steers a dish that moves one axis at a time and keeps every command that it gets.

`docs/tracking.md`, *How it follows*. It gets one command at a time, chosen by looking two moves ahead, sent to arrive
as the previous move ends: a queue that is fed faster than it drains only grows.
"""

from __future__ import annotations

from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.steering.axis_belief import AxisBelief
from birdcage.tracking.steering.latency import Latency
from birdcage.tracking.steering.lookahead import Lookahead
from birdcage.tracking.steps import ReadPosition, Send, Steps, Wait

REST_S = 0.05
"""How long it waits where nothing has to move."""
SLACK_S = 0.003
"""How much longer a move may take than it should: a queue that never runs dry adds up what each is late by."""


def queued(guide: ControllerInput) -> Steps:
    """Follow with the next command on its way while the last move ends; the position that is read is a check."""
    yield from steer(guide, looks=True)


def steer(guide: ControllerInput, *, looks: bool) -> Steps:
    """Follow with or without reading the position."""
    axes = guide.model.azimuth, guide.model.elevation
    latency = Latency(guide.model, guide.latency_s)
    ahead = Lookahead(axes, (guide.least_way_deg(axes[0]), guide.least_way_deg(axes[1])))
    beliefs = AxisBelief(axes[0], guide.start_az_deg, guide.now_s), AxisBelief(axes[1], guide.start_el_deg, guide.now_s)
    now_s, look_s = guide.now_s, guide.now_s + guide.look_every_s
    ends_s = now_s
    while now_s < guide.until_s:
        send_s = ends_s - latency.mean_s
        fits = now_s + 2.0 * latency.mean_s <= send_s
        if looks and now_s >= look_s and (fits or now_s >= look_s + guide.look_every_s):
            # Made before the next command has to leave; one that never fits is made all the same.
            seen = yield ReadPosition()
            now_s, look_s = seen.now_s, guide.next_look_s(look_s + guide.look_every_s, seen.now_s)
            for belief, read_deg in zip(beliefs, (seen.az_deg, seen.el_deg), strict=True):
                belief.check(read_deg, latency.seen_s(seen))
            continue
        if send_s > now_s:
            until_s = min(send_s, look_s if looks and look_s > now_s else send_s, guide.until_s)
            now_s = (yield Wait(until_s)).now_s
            continue
        start_s = max(now_s + latency.mean_s, ends_s)
        stands = beliefs[0].goal_deg, beliefs[1].goal_deg
        move = ahead.choose(guide.course(), stands, start_s)
        if move is None:
            now_s = (yield Wait(min(now_s + REST_S, guide.until_s))).now_s
            continue
        index = axes[move.column].index
        answer = yield Send(index, move.goal_deg)
        arrived_s = latency.measure(index, answer, move.lasts_s)
        begins_s = max(arrived_s, ends_s)
        beliefs[move.column].send(move.goal_deg, begins_s)
        ends_s = max(beliefs[move.column].rests_s, begins_s + move.lasts_s) + SLACK_S
        now_s, guide.latency_s = answer.now_s, latency.mean_s
