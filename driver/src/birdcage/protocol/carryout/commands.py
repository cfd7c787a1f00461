"""The commands of a Carryout of 2003, menu by menu. No full list is known, and none at all of `motor`, `dvb`, `os`."""

from __future__ import annotations

from birdcage.rotator.raw import CommandDoc

_BACK = "q | | back to the root"
_LIST = "? | | lists commands"
_LISTED = {
    "root": (
        "target | | go-to",
        "motor | | motors by hand, and their settings",
        "dvb | | signal of the stock LNB",
        "os | | processes of the dish",
        "nvs | | settings of the dish",
        _LIST,
    ),
    "target": ("g | <az> <el> | sends the dish; it tells where it is while it moves", _LIST, _BACK),
    "motor": (_LIST, _BACK),
    "dvb": (_LIST, _BACK),
    "os": (_LIST, _BACK),
    "nvs": (
        "e | <index> [<value>] | reads or changes a setting",
        "s | | saves all changes to flash",
        _LIST,
        _BACK,
    ),
}

COMMANDS = tuple(
    CommandDoc(menu, name, f"{name} {arguments}".strip(), text)
    for menu, lines in _LISTED.items()
    for name, arguments, text in ((part.strip() for part in line.split("|")) for line in lines)
)
