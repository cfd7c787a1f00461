"""HELD of a dish that no program of ours drives now: looked at, latched and released on disk. Nothing is sent."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from birdcage.base.errors import BirdcageError
from birdcage.base.held import FILE, HeldFile, HeldNote, HeldReason
from birdcage.base.paths import Paths
from birdcage.link.identity import FOLDER, dish_folder, dish_identity
from birdcage.link.ports import PortLister, list_ports


@dataclass(frozen=True, slots=True)
class HeldDish:
    """A dish that is held, and its latch."""

    file: HeldFile
    note: HeldNote

    def release(self) -> None:
        """Release it. BirdcageError where its file cannot be removed."""
        try:
            self.file.remove()
        except OSError as error:
            raise BirdcageError(
                f"{self.file.path} cannot be removed ({error.strerror or error}), so the dish stays HELD."
            ) from error


def find_held(paths: Paths, port: str, ports: PortLister = list_ports) -> HeldDish | None:
    """Return the dish at `port` if it is held. A port that is gone is looked for under the name that it had."""
    identity = dish_identity(port, ports)
    if identity is None:
        return next((held for held in list_held(paths, ports) if held.note.port == port), None)
    file = HeldFile(dish_folder(paths.state, identity))
    note = file.read()
    return None if note is None else HeldDish(file, note)


def list_held(paths: Paths, ports: PortLister = list_ports) -> list[HeldDish]:
    """Return every dish that is held. A latch of a pseudo terminal that has ended since is none."""
    found = []
    for path in sorted((paths.state / FOLDER).glob(f"*/{FILE}")):
        file = HeldFile(path.parent)
        note = file.read()
        if note is not None and not _has_ended(paths, path.parent.name, note, ports):
            found.append(HeldDish(file, note))
    return found


def hold(paths: Paths, port: str, by: str, utc: datetime, ports: PortLister = list_ports) -> HeldNote:
    """Latch the dish at `port`. BirdcageError where it cannot be told which dish that is, or nothing be written."""
    identity = dish_identity(port, ports)
    if identity is None:
        raise BirdcageError(
            f"{port} is not there, or is a simulator inside one program: there is no dish to hold. "
            "`birdcage ports` lists the ports."
        )
    file, note = HeldFile(dish_folder(paths.state, identity)), HeldNote(by, utc, HeldReason.STOP, port)
    try:
        file.write(note)
    except OSError as error:
        raise BirdcageError(
            f"{file.path} cannot be written ({error.strerror or error}), so the dish is not held. Cut its power."
        ) from error
    return file.read() or note


def _has_ended(paths: Paths, folder: str, note: HeldNote, ports: PortLister) -> bool:
    if not folder.startswith("pty-"):
        return False
    identity = dish_identity(note.port, ports)
    return identity is None or dish_folder(paths.state, identity).name != folder
