"""The commands that sources tell of a relative's console, menu by menu. No full list is known."""

from __future__ import annotations

from collections.abc import Iterable

from birdcage.rotator.raw import CommandDoc

_LISTED = {
    "root": (
        "mot | | motors",
        "nvs | | settings of the dish",
        "? | | lists commands",
        "q | | may end the shell until a power cycle",
    ),
    "mot": (
        "a | <motor> <angle> | sends an axis: 0 azimuth, 1 elevation",
        "h | <motor> | finds the reference of an axis, * of both",
        "? | | lists commands",
        "q | | back to the root",
    ),
    "nvs": (
        "d | [<row>] | shows settings",
        "e | <row> <value> | changes a setting",
        "s | | saves all changes to flash",
        "? | | lists commands",
        "q | | back to the root",
    ),
}


def kin_commands(menus: Iterable[str]) -> tuple[CommandDoc, ...]:
    """Return the commands of a console with these menus."""
    own = frozenset(menus)
    return tuple(
        CommandDoc(menu, name, f"{name} {arguments}".strip(), text)
        for menu, lines in _LISTED.items()
        for name, arguments, text in ((part.strip() for part in line.split("|")) for line in lines)
        if menu in own and (name in own or name not in _LISTED)
    )
