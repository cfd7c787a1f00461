"""The system menu, `OS>`: who the dish is (docs/reference/g2.md, *Identity*)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.reading import END
from birdcage.protocol.g2.room import Room

_FIELD = re.compile(r"^\s*([A-Za-z][\w -]*?):\s+(.+?)\s*$")
_WHOLE = re.compile(rf"(?:0x[0-9A-Fa-f]+|\d+){END}")


@dataclass(frozen=True, slots=True)
class DishIdentity:
    """What `id` tells. What it does not tell is None; `fields` holds all that it does, as printed."""

    software: str | None
    system_id: str | None
    antenna_id: str | None
    package: str | None
    silicon_revision: str | None
    mask_set: str | None
    program_flash_kb: int | None
    ram_kb: int | None
    core_clock_mhz: int | None
    bus_clock_mhz: int | None
    flash_base: int | None
    flash_size_bytes: int | None
    fields: Mapping[str, str]


class System(Room):
    """Identity."""

    menu: ClassVar[str] = "os"

    def fields(self) -> dict[str, str]:
        """Read `id` as the fields that it prints, by name; empty when it prints none."""
        return {m[1]: m[2] for m in map(_FIELD.match, self._run("id").lines) if m}

    def identity(self) -> DishIdentity:
        """Read `id`."""
        fields = self.fields()
        if not fields:
            raise NoReply("The dish answered `id` with no field of an identity.", reason=Reason.GARBAGE)
        return DishIdentity(
            software=fields.get("Software"),
            system_id=fields.get("System ID"),
            antenna_id=fields.get("Antenna ID"),
            package=fields.get("Package"),
            silicon_revision=fields.get("Silicon Rev"),
            mask_set=fields.get("Mask Set"),
            program_flash_kb=_whole(fields.get("P-Flash")),
            ram_kb=_whole(fields.get("RAM")),
            core_clock_mhz=_whole(fields.get("Core Clock")),
            bus_clock_mhz=_whole(fields.get("Bus Clock")),
            flash_base=_whole(fields.get("Flash Base")),
            flash_size_bytes=_whole(fields.get("Flash Size")),
            fields=fields,
        )


def _whole(text: str | None) -> int | None:
    match = _WHOLE.match(text or "")
    return int(match[0], 0) if match else None
