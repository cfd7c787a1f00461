"""A console with menus in a menu, as an indoor unit has it that leads to the dish: `odu`, and in it `mot`, `nvs`."""

from __future__ import annotations

import re
import sys

from birdcage.console.dialect import ConsoleDialect

scripted = sys.modules["console_scripted"]
PARENTS = {"odu": "root", "mot": "odu", "nvs": "odu"}
NAMED = {"root": "IDU>", "odu": "ODU>", "mot": "MOT>", "nvs": "NVS>"}
ALIKE = dict.fromkeys(NAMED, ">")
TWO = {"root": "IDU>", "odu": ">", "mot": ">", "nvs": ">"}
HELP_OF = {
    "root": ("odu - the dish", "ver - versions", "gps - place", "q - leaves"),
    "odu": ("Enter <mot> - Motor", "Enter <nvs> - Settings", "reboot", "stow", "q - leaves"),
    "mot": ("a [<motor> <angle>]", "h <motor>", "q - leaves"),
    "nvs": ("d", "e <index> [<value>]", "s", "q - leaves"),
}
REFUSALS = ((re.compile(r"Invalid (command|parameter)"), "unknown_command"),)
WITHIN = {"mot": "odu", "nvs": "odu"}
KNOWN = ConsoleDialect(prompts=NAMED, parents=WITHIN, refusals=REFUSALS)
LEARNT = ConsoleDialect(
    prompts=dict.fromkeys(NAMED, ""), parents=WITHIN, refusals=REFUSALS,
    root_marks=frozenset({"odu", "gps"}), root_hints=frozenset({"ver"}),
    submenu_marks={"odu": frozenset({"mot", "nvs"}), "mot": frozenset("ah"), "nvs": frozenset("des")},
)  # fmt: skip


class Dish(scripted.Dish):
    """Each `q` leaves one menu; at the root it kills."""

    def __init__(self, clock, **options):
        super().__init__(clock, **{"prompts": NAMED, "help_of": HELP_OF, **options})

    def _line(self, line, at):
        above = PARENTS.get(self.menu)
        if line == "q" and above is not None:
            self.heard.append((self.menu, line))
            self.menu = above
        elif PARENTS.get(line) == self.menu:
            self.heard.append((self.menu, line))
            self.menu = line
        elif line in PARENTS:
            self.heard.append((self.menu, line))
            self.say("Invalid command\r\n", at)
        else:
            super()._line(line, at)
            return
        self.say(self.prompts[self.menu], at)
