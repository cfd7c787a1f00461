"""The commands of the Trav'ler with HAL 2.05, menu by menu (`docs/reference/travler.md`, *Prompts and menus*).

No full list is known.
"""

from __future__ import annotations

from birdcage.rotator.raw import CommandDoc

_LISTED = {
    "root": """
        motor | | motors and position
        ngsearch | | the dish's own TV search
        nvs | | settings of the dish
        reboot | | restarts the dish
        stow | | folds the dish flat
        ? | | lists commands
        q | | may end the shell until a power cycle
    """,
    "motor": """
        a | [<motor> <angle>] | position and cable; or sends one axis to an angle, after the move under way
        g | <az> <el> <sk> | all axes at once; any key ends it
        ? | | lists commands
        q | | back to the root
    """,
    "ngsearch": """
        s | | ends the TV search until the next power-up
        ? | | lists commands
        q | | back to the root
    """,
    "nvs": """
        d | [<index>] | shows settings
        e | <index> [<value>] | reads or changes a setting
        s | | saves all changes to flash
        ? | | lists commands
        q | | back to the root
    """,
}

COMMANDS = tuple(
    CommandDoc(menu, name, f"{name} {arguments}".strip(), text)
    for menu, block in _LISTED.items()
    for name, arguments, text in ((part.strip() for part in line.split("|")) for line in block.strip().splitlines())
)
