"""Orders of the pursuit desk and what it shows, as JSON: for faces that are attached to its program.

order      {"type": "ChooseOrder", "text": "iss", "target": null}
news       what `DeskNow` has, with the outline of each plan (`birdcage.station.plan_form`)
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, cast

from birdcage.base.errors import BadMessage
from birdcage.pursuit import orders
from birdcage.pursuit.now import DeskNow
from birdcage.pursuit.orders import ChooseOrder, Order
from birdcage.station.json_shapes import FieldsShape
from birdcage.station.json_values import shown

if TYPE_CHECKING:
    from birdcage.sky.targets import Target

FROM_OUTSIDE: Mapping[str, type[Order]] = {
    each.__name__: each
    for each in (
        orders.SearchOrder, orders.LocateOrder, ChooseOrder, orders.ChoosePassOrder, orders.TimeOffsetOrder,
        orders.FrequencyOrder, orders.AimOrder, orders.FollowOrder, orders.LeaveOrder, orders.TakeUpOrder,
        orders.ResumeOrder, orders.ForgetOrder, orders.AutotrackOrder, orders.ReadSettingsOrder,
    )
}  # fmt: skip
"""What another program may order."""
MOST_OFFSET_S = 3600.0


def order_to_json(order: Order) -> dict[str, object]:
    """Return an order as JSON. BadMessage for one that stays inside its program."""
    kind = type(order)
    if FROM_OUTSIDE.get(kind.__name__) is not kind:
        raise BadMessage(f"{kind.__name__} has no JSON form.")
    if isinstance(order, ChooseOrder) and order.target is not None:
        order = replace(order, target=cast("Target", _target_to_json(order.target)))
    return {"type": kind.__name__, **_shape_of(kind).tell(order, kind.__name__)}


def order_from_json(told: object) -> Order:
    """Return the order that JSON is. BadMessage for all else."""
    if not isinstance(told, dict):
        raise BadMessage(f"The order is {shown(told)}. Give an object.")
    name = told.get("type")
    kind = FROM_OUTSIDE.get(name) if isinstance(name, str) else None
    if kind is None:
        raise BadMessage(f"{shown(name)} is no order here. There are {', '.join(FROM_OUTSIDE)}.")
    fields = {key: each for key, each in told.items() if key != "type"}
    order: Order = _shape_of(kind).take(fields, kind.__name__)
    if isinstance(order, ChooseOrder) and order.target is not None:
        order = replace(order, target=_target_from_json(order.target))
    if isinstance(order, orders.TimeOffsetOrder) and abs(order.seconds) > MOST_OFFSET_S:
        raise BadMessage(f"TimeOffsetOrder.seconds is {order.seconds:g}. Give at most {MOST_OFFSET_S:.0f} s.")
    return order


def now_to_json(now: DeskNow) -> dict[str, object]:
    """Return what a desk shows as JSON, with outlines of its plans."""
    return _shape_of(DeskNow).tell(now, "now")


def now_from_json(told: object) -> DeskNow:
    """Return what a desk shows, with outlines as plans. BadMessage for all else."""
    now: DeskNow = _shape_of(DeskNow).take(told, "The news")
    return now


@cache
def _shape_of(kind: type) -> FieldsShape:
    return FieldsShape(kind)


@cache
def _target_kinds() -> Mapping[str, type]:
    from birdcage.sky.targets.model import BodyTarget, Fixed, Satellite, SlotTarget, Star

    return {"satellite": Satellite, "slot": SlotTarget, "body": BodyTarget, "star": Star, "fixed": Fixed}


def _target_to_json(target: Target) -> dict[str, object]:
    return {"kind": target.kind, **_shape_of(_target_kinds()[target.kind]).tell(target, "target")}


def _target_from_json(told: Any) -> Target:  # noqa: ANN401 - any JSON
    kind = told.get("kind") if isinstance(told, dict) else None
    if not isinstance(kind, str) or kind not in _target_kinds():
        raise BadMessage(f"The target is {shown(told)}. Give an object with a kind: {', '.join(_target_kinds())}.")
    fields = {key: each for key, each in told.items() if key != "kind"}
    target: Target = _shape_of(_target_kinds()[kind]).take(fields, "target")
    return target
