"""How a setting is declared: a dataclass field that carries its documentation, range and variable."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

Complaint = tuple[str, str]
"""A key and what is wrong with its value, as the end of a sentence that begins with the key."""


@dataclass(frozen=True, slots=True)
class Declared:
    """What a field says of itself beside its name, type and default."""

    doc: str
    minimum: float | None = None
    maximum: float | None = None
    env: str | None = None


class Section:
    """Base of every table of the file."""

    section: ClassVar[str]
    limits_motion: ClassVar[bool] = False
    """Whether motion is refused while something in this section cannot be read."""

    __slots__ = ()

    def complaints(self) -> Iterator[Complaint]:
        """Yield what is wrong between keys that are each right by themselves."""
        yield from ()


def setting(
    default: Any,  # noqa: ANN401  (like dataclasses.field, it stands for a value of any type)
    doc: str,
    *,
    minimum: float | None = None,
    maximum: float | None = None,
    env: str | None = None,
) -> Any:  # noqa: ANN401
    """Declare a setting. The unit is the suffix of its name; choices are its Literal type.

    `env` is the variable that overrides the file; without it, that is `BIRDCAGE_SECTION_KEY`.
    """
    return dataclasses.field(default=default, metadata={"declared": Declared(doc, minimum, maximum, env)})
