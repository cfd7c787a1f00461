"""Write docs/events.md, the JSON form of events and requests, from the dataclasses themselves: `event_tables.py
[--check]`.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
import textwrap
from dataclasses import is_dataclass
from pathlib import Path
from typing import get_args, get_type_hints

from birdcage.detection.probe import BaudFinding
from birdcage.rotator.feature import Range, Reading
from birdcage.rotator.own_settings import SettingsTable, SettingsWritten
from birdcage.station.attach_messages import Attached, result_shapes
from birdcage.station.control_messages import FROM_OUTSIDE, EventsEnded
from birdcage.station.events import Event
from birdcage.station.json_form import STAYS_INSIDE, event_types, fields_of, request_types
from birdcage.station.json_shapes import NAMES
from birdcage.station.json_values import Shape
from birdcage.station.raw import MenuCommand, RawReply
from birdcage.station.state import Pointing, StationState

PAGE = Path(__file__).resolve().parents[1] / "docs/events.md"
RESULTS = {
    "Stop": "what STOP did, as `birdcage stop --json` prints it: `by`, `means`, `confirmed`, `sentence`",
    "HoldDish": "as of `Stop`",
    "Release": "`held`, `was`, `next_holder`, `trouble`, as `birdcage release --json` prints it",
    "TellStatus": "the state, as `birdcage status --json` prints it, without `wear`",
    "ListFeatures": "`firmware` and `features`, as `birdcage features --json` prints them",
    "Read": "an object: for each name that the dish told a [Reading](#reading)",
    "Set": "the [Reading](#reading) that was read back",
    "ReadSettings": "a [SettingsTable](#settingstable)",
    "WriteSettings": "a [SettingsWritten](#settingswritten)",
    "SaveSettings": "a [SettingsTable](#settingstable), as it is then",
    "Watch": "null; the watch ends when the caller hangs up",
    "Unwatch": "null",
    "Attach": "[Attached](#attached); then lines go both ways ([The state](#the-state))",
}
HEADER = """\
# Events and requests in JSON

What the station tells and is asked has one JSON form. `birdcage events --json` prints it, the control channel speaks it
([Architecture](architecture.md#the-control-channel)), and tests write it. `scripts/event_tables.py` writes this page
from the classes, and a test holds it to them.

```json
{"v": 1, "type": "LeaseChanged", "at": 3182.3, "utc": "2026-11-23T06:33:35.777000Z", "holder": "anna", "previous": null}
```

- `v` is the version of the form, 1 now. A program reads its own version. A later one is refused, and told to update.
- `type` is the name of the class; the rest are its fields. Written, all of them are there. Read, one with a default may
  be left out. A field or type that is unknown is an error, which names it and what there is.
- Angles are degrees. Azimuth counts clockwise from true north, unless a field says otherwise.
- A time is UTC, as `2026-11-23T06:04:28.250000Z`. *Monotonic seconds* go by the clock of the program that has the port:
  only differences of two mean something.
- Null is what is not known, or does not apply. No number is NaN or infinite.
- Text that is read loses control characters and the like. The value of a feature with several lines is a list of them.
- The plan of a pursuit is told by its [outline](#planoutline).
"""
STATE = """
## The state

A program that is [attached](#attach) is told the state: once whole, then each time what has changed of it, by field.

```json
{"v": 1, "type": "StateTold", "state": {"link": {"state": "up", "since": 3182.3}, "port": "/dev/ttyUSB0"}}
{"v": 1, "type": "StateChanged", "changes": {"holder": "anna (pts/3)", "target_az_deg": 180.0}}
```

State, events and answers come in the order in which they came to be: a state is never older than the event or the
answer behind it. Changes without an event gather for 20 ms.

Told in outline: the plan of a pursuit ([PlanOutline](#planoutline)), and how the axes of a machine without azimuth and
elevation point to the sky ([MappingOutline](#mappingoutline)). With more than one such axis a
face can't draw the curve.
"""
OUTSIDE = """
## Requests from other programs

These may be asked in the first line on the control channel, and no others: none of them is a motion. The result of each
stands under its table.
"""
INSIDE = """
## Requests of attached programs

A program that is attached may ask these as well, each with a number. Its answer has the same number, and the result:
null unless it is said here. A go-to is answered at its arrival.

```json
{"v": 1, "id": 7, "request": {"v": 1, "type": "Jog", "d_az_deg": 1.0, "d_el_deg": 0.0, "holder": "anna (pts/3)"}}
{"v": 1, "id": 7, "ok": false, "error": {"kind": "Held", "reason": "held", "sentence": "HELD by bert (pts/4)."}}
```

A holder is whom control is given to: the name of `Attached`, or another one that is the caller's alone. `you` is the
person at the program that has the port, and refused.
"""


def null_for_none(text: str) -> str:
    """Return what a docstring says in the words of JSON."""
    return re.sub(r"\bNone\b", "null", text)


def notes_of(kind: type) -> dict[str, str]:
    """Return what stands under each field of a class, and of those it is made from."""
    notes: dict[str, str] = {}
    for each in reversed([base for base in kind.__mro__ if base not in (object, tuple)]):
        (tree,) = ast.parse(textwrap.dedent(inspect.getsource(each))).body
        assert isinstance(tree, ast.ClassDef)
        for field, note in zip(tree.body, tree.body[1:], strict=False):
            told = note.value.value if isinstance(note, ast.Expr) and isinstance(note.value, ast.Constant) else None
            if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name) and isinstance(told, str):
                notes[field.target.id] = null_for_none(" ".join(told.split()))
    return notes


def linked(words: str) -> str:
    """Return the words of a shape, its classes as links."""
    return re.sub(r"\((\w+)\)", lambda found: f"([{found[1]}](#{found[1].lower()}))", words).replace('"', "`")


def kinds_in(shape: Shape) -> list[type]:
    """Return the classes that the words of a result name."""
    named = re.findall(r"\((\w+)\)", shape.words)
    kinds = (BaudFinding, MenuCommand, Pointing, RawReply, Reading, SettingsTable, SettingsWritten)
    return [each for each in kinds if each.__name__ in named]


def section(kind: type) -> list[str]:
    """Return the part of the page on one class."""
    lines = [
        f"\n### {kind.__name__}\n",
        *(null_for_none(" ".join(each.split())) + "\n" for each in (kind.__doc__ or "").split("\n\n")),
    ]
    notes, shared = notes_of(kind), {"at", "utc"} if issubclass(kind, Event) else set()
    rows = []
    for field in fields_of(kind).fields:
        if field.name not in shared:
            words = linked(field.shape.words)
            name = f"`{field.name}`" if field.required else f"`{field.name}` \\*"
            rows.append(f"| {name} | {words} | {notes.get(field.name, '')} |".replace("|  |", "| |"))
    if rows:
        lines += ["| Field | JSON | What |", "|---|---|---|", *rows]
    return lines


def has_fields(kind: type) -> bool:
    """Return whether a class is told as an object with fields of its own."""
    return kind is not Range and (is_dataclass(kind) or hasattr(kind, "_fields"))


def parts_of(kinds: list[type]) -> list[type]:
    """Return the dataclasses that these hold, in the order in which they occur."""
    found: dict[type, None] = {}
    waiting = list(kinds)
    while waiting:
        hints = get_type_hints(waiting.pop(0), localns=NAMES)
        for hint in hints.values():
            for each in (hint, *get_args(hint)):
                if isinstance(each, type) and has_fields(each) and each not in found:
                    found[each] = None
                    waiting.append(each)
    return list(found)


def page() -> str:
    """Return the whole page."""
    events = list(event_types().values())
    inside = [each for each in request_types().values() if each not in FROM_OUTSIDE.values()]
    results = [each for shape in result_shapes().values() for each in kinds_in(shape)]
    known = [*events, StationState, *FROM_OUTSIDE.values(), *inside, *results]
    parts = [Attached, *parts_of(known), *(each for each in results if each is not Reading), Reading]
    parts = [each for each in dict.fromkeys(parts) if each is not StationState]
    lines = [HEADER, "\\* may be left out when read.\n", "## Events\n"]
    lines += [
        "Each has `at`, the monotonic seconds at which it happened, and `utc`, the same as a time. On the control"
    ]
    lines += ["channel the last line is [EventsEnded](#eventsended), which has neither.", ""]
    lines += [f"- [{each.__name__}](#{each.__name__.lower()})" for each in events]
    for each in (*events, EventsEnded):
        lines += section(each)
    lines += [STATE.rstrip(), *section(StationState)]
    lines += ["\n## What events and the state hold"]
    for each in parts:
        lines += section(each)
    lines.append(OUTSIDE.rstrip())
    for name, each in FROM_OUTSIDE.items():
        lines += [*section(each), f"\nResult: {RESULTS[name]}."]
    lines.append(INSIDE.rstrip())
    for each in inside:
        result = result_shapes().get(each)
        lines += [*section(each), *([] if result is None else [f"\nResult: {linked(result.words)}."])]
    lines.append("\n### Requests without a form\n")
    lines += [f"- `{each.__name__}`: {why}" for each, why in STAYS_INSIDE.items()]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)) + "\n"


def main() -> None:
    if "--check" not in sys.argv:
        PAGE.write_text(page(), encoding="utf-8")
    elif page() != PAGE.read_text(encoding="utf-8"):
        sys.exit(f"{PAGE.name} is not what requests and events are. Run scripts/event_tables.py.")


if __name__ == "__main__":
    main()
