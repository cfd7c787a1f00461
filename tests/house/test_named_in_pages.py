"""What the pages about the code name exists: paths, modules, classes, functions; and what they quote stands there."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, field
from functools import cache

import pytest
from birdcage.link.opening import ENTRY_POINTS
from birdcage.rotator.machines import DIALECTS, MACHINES
from birdcage.sim.port import TWINS

from tests.house.pages import ROOT, text_of

ABOUT_THE_CODE = ("CONTRIBUTING.md", "docs/architecture.md")
BELOW = ("", "docs", "driver/src/birdcage", "tui/src/birdcage_tui", "driver/src", "tui/src")
"""Where a path that a page names may begin."""
GROUPS = frozenset({ENTRY_POINTS, DIALECTS, MACHINES, TWINS})
"""Of entry points."""
OF_THE_USER = frozenset({"birdcage.toml"})
"""Files that stand in nobody's clone."""
_FENCED = re.compile(r"^ *```\w*\n.*?^ *```$", flags=re.DOTALL | re.MULTILINE)
_SPAN = re.compile(r"`([^`\n]+)`")
_PATH = re.compile(r"[\w.*-]*/[\w./*-]*|[\w-]+\.(?:py|md|toml|tcss)")
_NAME = re.compile(r"[A-Za-z_]\w*(?:\.\w+)*")
_HOP = re.compile(r"(?:`([\w/]+\.py)`|the same): `(\w+(?:\.\w+)?)`")
"""A file and what is to be found in it."""
_QUOTE = re.compile(r"From\s+`([\w./-]+)`:\n\n *```py\n(.*?)^ *```$", flags=re.DOTALL | re.MULTILINE)
"""A block that is introduced by the file that it stands in."""
_VARIABLE = re.compile(r"BIRDCAGE_[A-Z_]+")


@dataclass
class Names:
    """What one file or one class defines."""

    members: set[str] = field(default_factory=set)
    bases: set[str] = field(default_factory=set)
    written: set[str] = field(default_factory=set)
    """The classes and functions of a file: what it imports is no part of these."""


def _targets(node: ast.stmt) -> set[str]:
    """Return the names that a statement binds."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return {node.name}
    if isinstance(node, ast.Import | ast.ImportFrom):
        return {alias.asname or alias.name for alias in node.names}
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return {each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)}


def _of_class(node: ast.ClassDef) -> Names:
    own = {
        each.attr
        for each in ast.walk(node)
        if isinstance(each, ast.Attribute) and isinstance(each.value, ast.Name) and each.value.id == "self"
        and isinstance(each.ctx, ast.Store)
    }  # fmt: skip
    bases = {each.id for base in node.bases for each in ast.walk(base) if isinstance(each, ast.Name)}
    return Names(own.union(*(_targets(each) for each in node.body)), bases)


@cache
def index() -> tuple[dict[str, Names], dict[str, Names]]:
    """Return what each module and each class defines: modules by dotted name, classes by their own.

    What the tests define counts by its whole name alone: `tests.station.conftest.Bench`.
    """
    modules: dict[str, Names] = {}
    classes: dict[str, Names] = {}
    for folder in ("driver/src", "tui/src", ""):
        for path in sorted((ROOT / folder if folder else ROOT / "tests").rglob("*.py")):
            dotted = ".".join(path.relative_to(ROOT / folder).with_suffix("").parts).removesuffix(".__init__")
            tree = ast.parse(path.read_text(encoding="utf-8"))
            written = {node.name for node in tree.body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
            modules[dotted] = Names({name for node in tree.body for name in _targets(node)}, written=written)
            for node in tree.body:
                if folder and isinstance(node, ast.ClassDef):
                    known = classes.setdefault(node.name, Names())
                    found = _of_class(node)
                    known.members |= found.members
                    known.bases |= found.bases
    return modules, classes


def _is_member(kind: str, name: str) -> bool:
    names = index()[1].get(kind)
    return names is not None and (name in names.members or any(_is_member(base, name) for base in names.bases))


def is_defined(name: str) -> bool:
    """Return whether a dotted name leads to something: `station.stopper`, `Station.stop`, `base.clock.Clock.wait`."""
    modules, classes = index()
    parts = name.split(".")
    if name in GROUPS or name in modules:
        return True
    if len(parts) == 1:
        ours = {module: names for module, names in modules.items() if not module.startswith("tests")}
        tails = {module.rpartition(".")[2] for module in ours}
        return name in tails or any(name in each.members for each in (*ours.values(), *classes.values()))
    if len(parts) == 2 and _is_member(*parts):
        return True
    for cut in range(len(parts), 0, -1):
        head, rest = ".".join(parts[:cut]), parts[cut:]
        for module, names in modules.items():
            if module != head and (module.startswith("tests") or not module.endswith(f".{head}")):
                continue
            if not rest or (rest[0] in names.members and (len(rest) == 1 or _is_member(*rest))):
                return True
    return False


def missing(text: str) -> list[str]:
    """Return what a text names in backticks and nothing is called."""
    found = []
    for span in _SPAN.findall(_FENCED.sub("", text)):
        name = re.sub(r"\(.*\)$", "", span)
        if _PATH.fullmatch(span):
            if span not in OF_THE_USER and not any(list((ROOT / folder).glob(span.strip("/"))) for folder in BELOW):
                found.append(span)
        elif (
            not _VARIABLE.fullmatch(span)
            and _NAME.fullmatch(name)
            and re.search(r"[._]|[a-z][A-Z]|[A-Z][a-z]", name)
            and not is_defined(name)
        ):
            found.append(span)
    return found


@pytest.mark.parametrize("page", ABOUT_THE_CODE)
def test_what_a_page_about_the_code_names_exists(page: str) -> None:
    assert missing(text_of(page)) == []


def astray(text: str) -> list[str]:
    """Return the hops of a journey that are not in the file that is named for them."""
    found, file = [], ""
    for path, name in _HOP.findall(text):
        file = path or file
        head, *member = name.split(".")
        module = file.removesuffix(".py").replace("/", ".")
        modules, classes = index()
        names = modules.get(module) or modules.get(f"birdcage.{module}")
        if names is None or head not in names.written or (member and member[0] not in classes[head].members):
            found.append(f"{file}: {name}")
    return found


def test_each_hop_of_a_journey_is_in_its_file() -> None:
    page = text_of("docs/architecture.md")
    assert len(_HOP.findall(page)) > 30
    assert astray(page) == []
    assert astray("| `station/station.py`: `Stopper.call` |") == ["station/station.py: Stopper.call"]


@pytest.mark.parametrize("page", ABOUT_THE_CODE)
def test_what_a_page_about_the_code_quotes_stands_there(page: str) -> None:
    for path, block in _QUOTE.findall(text_of(page)):
        source = (ROOT / path).read_text(encoding="utf-8")
        assert _bare(block) in _bare(source), f"{page}: {path} has changed:\n{block}"


def _bare(source: str) -> str:
    """Return code without what a formatter changes: white space, and the comma at the end of a list."""
    return re.sub(r",(?=[)\]}])", "", re.sub(r"\s|# fmt: skip", "", source))


@pytest.mark.parametrize(("text", "found"), [
    ("`Station.submit`, `station.stopper.Stopper.call`, `antenna.gate`", []), ("`Jog(1.0, 0.0)`, `stop_now`", []),
    ("`station/station.py`, `docs/safety.md`, `pyproject.toml`", []), ("`birdcage.dialects`, `PlainRotator`", []),
    ("`Station.submitted`", ["Station.submitted"]), ("`station.Desk`", ["station.Desk"]), ("`Desk`", ["Desk"]),
    ("`ring_it`", ["ring_it"]), ("`station/desk.py`", ["station/desk.py"]), ("`HELD`, `permit`, `a 0 1.00`", []),
])  # fmt: skip
def test_what_does_not_exist_is_seen(text: str, found: list[str]) -> None:
    assert missing(text) == found
