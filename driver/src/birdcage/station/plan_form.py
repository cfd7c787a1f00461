"""Plans as attached programs are told them: whole, curves and all, once each. Elsewhere their outline stands for them.

    told       {"v": 1, "type": "PlanTold", "plan": {"aim": …, "sky": {"t_s": [1774008000.0, …], "az_deg": …}, …}}

A state, an event or the news of a service that has the outline of a plan is told behind it.
"""

from __future__ import annotations

import json
import threading
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, cast

from birdcage.base.errors import BadMessage
from birdcage.station.json_form import VERSION, check_version
from birdcage.station.json_shapes import FieldsShape
from birdcage.station.plan_outline import PlanOutline, outline
from birdcage.station.pursuit_state import Pursuit

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

PLAN_TOLD = "PlanTold"
KEPT_LINES, TOLD, HEARD = 4, 4, 8
"""How many plans are kept as lines, and for one caller. Who hears them keeps more than who tells them relies on."""


@cache
def plan_shape() -> FieldsShape:
    """Return the shape of a whole plan."""
    from birdcage.tracking.plan import Plan

    return FieldsShape(Plan)


def plan_to_json(plan: Plan) -> dict[str, object]:
    """Return a plan, whole, as an object of JSON. BadMessage for one that JSON can't hold."""
    return {"v": VERSION, "type": PLAN_TOLD, "plan": plan_shape().tell(plan, "plan")}


def plan_from_json(told: Mapping[str, Any]) -> Plan:
    """Return the plan that a line tells. BadMessage for all else."""
    check_version(told, "The plan")
    plan: Plan = plan_shape().take(told.get("plan"), "The plan")
    return plan


class PlanLines:
    """The lines of the last plans: several callers are told the same. Any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._lines: deque[tuple[Plan, bytes]] = deque(maxlen=KEPT_LINES)

    def of(self, plan: Plan) -> bytes:
        """Return a plan as a line; empty for one that can't be told."""
        with self._lock:
            for known, line in self._lines:
                if known is plan:
                    return line
            try:
                line = _as_line(plan_to_json(plan))
            except BadMessage:
                line = b""
            self._lines.append((plan, line))
            return line


def _as_line(told: Mapping[str, Any]) -> bytes:
    """Return a plan as a line, made field by field: of half a megabyte at once STOP's thread would wait for ten ms."""
    fields = (json.dumps(name) + ":" + json.dumps(value) for name, value in told["plan"].items())
    head = json.dumps({name: value for name, value in told.items() if name != "plan"})
    return f'{head[:-1]}, "plan": {{{", ".join(fields)}}}}}\n'.encode()


class PlansTold:
    """What one caller was told of plans."""

    def __init__(self, lines: PlanLines) -> None:
        self._lines = lines
        self._told: deque[Plan] = deque(maxlen=TOLD)

    def lines(self, plans: Iterable[Plan]) -> bytes:
        """Return the lines of those that this caller does not have."""
        said = b""
        for plan in plans:
            if isinstance(plan, PlanOutline) or any(plan is each for each in self._told):
                continue
            self._told.append(plan)
            said += self._lines.of(plan)
        return said

    def line_of_pursuit(self, pursuit: Pursuit | None) -> bytes:
        """Return the line of a pursuit's plan; empty if this caller has it."""
        return b"" if pursuit is None else self.lines((pursuit.plan,))


class PlansHeard:
    """The last plans that a station has told, by their outlines."""

    def __init__(self) -> None:
        self._plans: dict[PlanOutline, Plan] = {}

    def take(self, told: Mapping[str, Any]) -> None:
        """Take in a plan that was told. BadMessage for what is none."""
        plan = plan_from_json(told)
        self._plans.pop(outline(plan), None)
        self._plans[outline(plan)] = plan
        while len(self._plans) > HEARD:
            del self._plans[next(iter(self._plans))]

    def whole(self, plan: Plan | PlanOutline | None) -> Plan | None:
        """Return the plan of an outline; the outline itself where the plan was not told."""
        found = self._plans.get(plan, plan) if isinstance(plan, PlanOutline) else plan
        return cast("Plan | None", found)

    def in_pursuit(self, pursuit: Pursuit) -> Pursuit:
        """Return a pursuit with its plan whole."""
        plan = self.whole(pursuit.plan)
        return pursuit if plan is None or plan is pursuit.plan else replace(pursuit, plan=plan)
