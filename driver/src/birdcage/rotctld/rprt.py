"""The codes with which the protocol answers (Hamlib's `rig_errcode_e`), and the error that carries one."""

from __future__ import annotations

from enum import IntEnum


class Rprt(IntEnum):
    """What stands after `RPRT`. Those that this server answers with, and no others."""

    OK = 0
    EINVAL = -1
    """An argument is wrong, or missing."""
    ENIMPL = -4
    """There is no such command here."""
    ETIMEOUT = -5
    """The dish did not answer in time."""
    EIO = -6
    """The dish can't be reached, or what was asked for is not known: no position that is true."""
    ERJCTED = -9
    """Refused: somebody else has control, the dish is HELD, or this client may only look."""
    ENAVAIL = -11
    """This dish can't do it, or it is not set up."""


class RotctldError(Exception):
    """A command that is not done; `code` is what its client gets, the sentence what a person gets."""

    def __init__(self, code: Rprt, sentence: str) -> None:
        super().__init__(sentence)
        self.code = code
