"""Collects the sentences that a person reads: string literals, click's help texts, docstrings, comments, Markdown."""

from __future__ import annotations

import ast
import inspect
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]

HOLE = "‹›"
"""Stands for a value that is filled in: one word."""

ON_THE_WIRE = (
    "birdcage/sim/g2/",
    "birdcage/sim/hal/",
    "birdcage/sim/carryout/",
    "birdcage/sim/shell.py",
    "birdcage/sim/shell_text.py",
)
"""What a dish prints, in its own words."""

NOT_READ = frozenset(
    {"compile", "search", "match", "fullmatch", "sub", "split", "execute", "executemany", "executescript"}
)
"""Methods whose strings are patterns or SQL, not words."""

LOGGERS = frozenset({"debug", "info", "warning", "exception", "critical", "log"})

SQL = re.compile(r"\s*(SELECT|INSERT|UPDATE|DELETE|CREATE|DROP|ALTER|PRAGMA|WITH|BEGIN|COMMIT|ATTACH|WHERE|ORDER)\b")


@dataclass(frozen=True, slots=True)
class Sentence:
    """One sentence, and the file and line where its text begins."""

    text: str
    where: str

    @property
    def words(self) -> int:
        """How many words it has: whatever holds a letter, a digit, or a value."""
        return sum(1 for word in self.text.split() if re.search(r"\w|‹", word))


def split(text: str) -> Iterator[str]:
    """Cut a text into sentences: at full stops, empty lines, lists, and where two spaces part two things."""
    for block in re.split(r"\n\s*\n|\n(?=\s*[-*#|] ?)|\x08|\n(?= {2})", text):
        for part in re.split(r"(?<=[.!?])[*`\"')\]]*\s+(?=\S)|\s{2,}|\t", " ".join(re.split(r"\n", block))):
            if part.strip():
                yield part.strip()


def _literal(node: ast.expr) -> str | None:
    """Return the words of a literal, a formatted one, or several that are added up; None for anything else."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else None
    if isinstance(node, ast.JoinedStr):
        return "".join(str(part.value) if isinstance(part, ast.Constant) else HOLE for part in node.values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = _literal(node.left), _literal(node.right)
        return None if left is None and right is None else (left or HOLE) + (right or HOLE)
    return None


def _called(node: ast.Call) -> str:
    function = node.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _is_command(node: ast.AST) -> bool:
    return isinstance(node, ast.FunctionDef) and any(
        isinstance(each, ast.Call) and _called(each) in ("command", "group") for each in node.decorator_list
    )


class _Reader(ast.NodeVisitor):
    """Walks a module and keeps what may be shown."""

    def __init__(self) -> None:
        self.found: list[tuple[int, str]] = []

    def visit(self, node: ast.AST) -> None:
        if isinstance(node, ast.expr) and (text := _literal(node)) is not None:
            if " " in text and not SQL.match(text):
                self.found.append((node.lineno, text))
            for value in ast.walk(node):
                if isinstance(value, ast.FormattedValue):
                    self.visit(value.value)
            return
        super().visit(node)

    def visit_Expr(self, node: ast.Expr) -> None:
        """Pass over docstrings: click's are read where their function is."""
        if not isinstance(node.value, ast.Constant):
            self.generic_visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        if _is_command(node) and (help_text := ast.get_docstring(node)):
            self.found.append((node.lineno, help_text.split("\f")[0]))
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:
        name = _called(node)
        if name in NOT_READ:
            self.visit(node.func)
            node.args = [each for each in node.args if _literal(each) is None]
        elif name in LOGGERS and isinstance(node.func, ast.Attribute):
            return
        self.generic_visit(node)

    def visit_Dict(self, node: ast.Dict) -> None:
        for value in node.values:
            self.visit(value)

    def visit_Subscript(self, node: ast.Subscript) -> None:
        self.visit(node.value)
        if not isinstance(node.slice, ast.Constant):
            self.visit(node.slice)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.visit(node.value)


def of_package(folder: str) -> list[Sentence]:
    """Return the sentences of all modules below a folder, with what the dish itself prints left out."""
    sentences = []
    for path in sorted((ROOT / folder).rglob("*.py")):
        name = path.relative_to(ROOT).as_posix()
        if any(part in name for part in ON_THE_WIRE):
            continue
        sentences += of_source(path.read_text(encoding="utf-8"), name)
    return sentences


def of_source(source: str, name: str) -> list[Sentence]:
    """Return the sentences of one module."""
    reader = _Reader()
    reader.visit(ast.parse(source))
    return [Sentence(part, f"{name}:{line}") for line, text in reader.found for part in split(text)]


def notes_of(source: str, name: str) -> list[Sentence]:
    """Return the docstrings and comments of one module, sentence by sentence, for whoever reads the code."""
    found = [
        (node.lineno, inspect.cleandoc(node.value.value))
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
    ]
    row, comment = 0, ""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type != tokenize.COMMENT:
            continue
        text = token.string.lstrip("#:! ")
        comment = f"{comment} {text}" if token.start[0] == row + 1 else text
        row = token.start[0]
        found.append((row, comment))
    return [Sentence(part, f"{name}:{line}") for line, text in found for part in split(text)]


def of_markdown() -> list[Sentence]:
    """Return the sentences of the README files and of docs/, without code and without the records in docs/decisions."""
    sentences = []
    for path in (*ROOT.glob("*/README.md"), ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
        prose = re.sub(r"```.*?```", "\n\n", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        where = path.relative_to(ROOT).as_posix()
        sentences += [Sentence(part, where) for part in split(re.sub(r"`[^`\n]*`", HOLE, prose))]
    return sentences
