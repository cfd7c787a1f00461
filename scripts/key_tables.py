"""Write the tables of keys in docs/using.md from the app's own commands: `key_tables.py [--check]`.

A table stands between `<!-- keys: SCOPE ... -->` and `<!-- /keys -->`, and has the commands of these scopes, those
that hold everywhere under the scope `everywhere`.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from birdcage_tui.commands import COMMANDS, Command

PAGE = Path(__file__).resolve().parents[1] / "docs/using.md"
PLACE = re.compile(r"(<!-- keys: ([\w\- ]+) -->\n).*?(<!-- /keys -->)", re.DOTALL)
EVERYWHERE = "everywhere"


def scopes_of(command: Command) -> tuple[str, ...]:
    """Return where a command holds."""
    return command.where or (EVERYWHERE,)


def table(scopes: list[str]) -> str:
    """Return the commands of these scopes, in the app's own order."""
    rows = ["", "| Key | What it does |", "|---|---|"]
    for command in COMMANDS:
        if any(scope in scopes for scope in scopes_of(command)):
            keys = " ".join(f"`{key}`" for key in command.shown.split())
            rows.append(f"| {keys} | **{command.title.removesuffix(' …')}.** {command.help} |")
    return "\n".join(rows) + "\n\n"


def filled(text: str) -> str:
    """Return a page with its tables as the app has them now."""
    return PLACE.sub(lambda found: f"{found[1]}{table(found[2].split())}{found[3]}", text)


def scopes_in(text: str) -> set[str]:
    """Return the scopes that a page has tables of."""
    return {scope for found in PLACE.finditer(text) for scope in found[2].split()}


def main() -> None:
    text = PAGE.read_text(encoding="utf-8")
    missing = {scope for command in COMMANDS for scope in scopes_of(command)} - scopes_in(text)
    if missing:
        sys.exit(f"{PAGE.name} has no table for {', '.join(sorted(missing))}.")
    if "--check" not in sys.argv:
        PAGE.write_text(filled(text), encoding="utf-8")
    elif filled(text) != text:
        sys.exit(f"{PAGE.name} has other keys than the app. Run scripts/key_tables.py.")


if __name__ == "__main__":
    main()
