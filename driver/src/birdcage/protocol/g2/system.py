"""The system menu, `OS>`: who the dish is (docs/reference/g2.md, *Identity*)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import ClassVar

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.trk.reading import END
from birdcage.protocol.trk.room import Room
from birdcage.rotator.feature import VERSION, Value

_FIELD = re.compile(r"^\s*([A-Za-z][\w -]*?):\s+(.+?)\s*$")
_WHOLE = re.compile(rf"(?:0x[0-9A-Fa-f]+|\d+){END}")
_TEXTS = {
    VERSION: "Software", "antenna_id": "Antenna ID", "system_id": "System ID",
    "mcu_package": "Package", "mcu_revision": "Silicon Rev", "mcu_mask_set": "Mask Set",
}  # fmt: skip
_NUMBERS = {
    "mcu_flash": "P-Flash", "mcu_ram": "RAM", "mcu_core_clock": "Core Clock", "mcu_bus_clock": "Bus Clock",
    "flash_base": "Flash Base", "flash_size": "Flash Size",
}  # fmt: skip
"""Features by the names that the dish prints."""


def identity_of(fields: Mapping[str, str]) -> dict[str, Value]:
    """Return what `id` tells as features, by its fields; what it does not tell is left out."""
    told: dict[str, Value] = {name: fields[field] for name, field in _TEXTS.items() if field in fields}
    for name, field in _NUMBERS.items():
        if match := _WHOLE.match(fields.get(field, "")):
            told[name] = int(match[0], 16 if match[0].startswith("0x") else 10)
    return told


class System(Room):
    """Identity."""

    menu: ClassVar[str] = "os"

    def fields(self) -> dict[str, str]:
        """Read `id` as the fields that it prints, by name; empty when it prints none."""
        return {m[1]: m[2] for m in map(_FIELD.match, self._run("id").lines) if m}

    def identity(self) -> dict[str, Value]:
        """Read `id` as features: version, antenna, system and processor."""
        fields = self.fields()
        if not fields:
            raise NoReply("The dish answered `id` with no field of an identity.", reason=Reason.GARBAGE)
        return identity_of(fields)
