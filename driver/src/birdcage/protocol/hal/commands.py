"""The commands of the Trav'lers, menu by menu (`docs/reference/travler.md`, *Prompts and menus*).

No full list is known.
"""

from __future__ import annotations

from birdcage.protocol.hal.variant import NVS, VARIANTS, HalVariant
from birdcage.rotator.raw import CommandDoc

_MENUS = {
    "motor": "motors and position",
    "mot": "motors and position",
    "ngsearch": "the dish's own TV search",
    "os": "tasks of the dish, its TV search among them",
    NVS: "settings of the dish",
}
_ROOT = """
    reboot | | restarts the dish
    stow | | folds the dish flat
    ? | | lists commands
    q | | may end the shell until a power cycle
"""
_LEAVE = """
    ? | | lists commands
    q | | back to the menu above
"""
_TUNNEL = """
    odu | | the outdoor unit, which has all the rest; no command is known that leads back
    ? | | lists commands
    q | | may end the shell until a power cycle
"""
_MOTOR = """
    a | [<motor> <angle>] | position and cable; or sends one axis to an angle, after the move under way
    g | <az> <el> <sk> | all axes at once; any key ends it
"""
_NVS = """
    d | [<index>] | shows settings
    e | <index> [<value>] | reads or changes a setting
    s | | saves all changes to flash
"""
_SEARCH = {
    "ngsearch": """
        s | | ends the TV search until the next power-up
    """,
    "os": """
        tasks | | lists the tasks that run
        kill | <name> | ends a task; `kill Search` {ends} the TV search until the next power-up
    """,
}


def commands_of(variant: HalVariant) -> tuple[CommandDoc, ...]:
    """Return what is documented of one of the Trav'lers."""
    root = "".join(f"{menu} | | {_MENUS[menu]}\n" for menu in variant.submenus) + _ROOT
    listed = {
        **({"root": _TUNNEL} if variant.home != "root" else {}),
        variant.home: root,
        variant.motor: _MOTOR + _LEAVE,
        variant.search: _SEARCH[variant.search].format(ends="ends" if variant.search_told else "may end") + _LEAVE,
        NVS: _NVS + _LEAVE,
    }
    return tuple(
        CommandDoc(menu, name, f"{name} {arguments}".strip(), text)
        for menu, block in listed.items()
        for line in block.splitlines()
        if line.strip()
        for name, arguments, text in [[part.strip() for part in line.split("|")]]
    )


COMMANDS = {variant.firmware: commands_of(variant) for variant in VARIANTS}
