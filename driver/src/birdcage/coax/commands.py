"""What the bytes of the DiSEqC bus mean, by number (docs/reference/diseqc.md)."""

from __future__ import annotations

FIRST, AGAIN = "first transmission", "repeated"
FRAMINGS = {
    0xE0: f"from the master, {FIRST}, no reply wanted",
    0xE1: f"from the master, {AGAIN}, no reply wanted",
    0xE2: f"from the master, {FIRST}, reply wanted",
    0xE3: f"from the master, {AGAIN}, reply wanted",
}
"""First bytes of what a receiver or birdcage sends."""
REPLIES = {
    0xE4: "reply: OK",
    0xE5: "reply: command not supported by the device",
    0xE6: "reply: parity error, send it again",
    0xE7: "reply: command not recognised, send it again",
}
"""First bytes of what a device answers."""
ADDRESSES = {
    0x00: "any device",
    0x10: "any LNB, switch or SMATV",
    0x11: "LNB",
    0x12: "LNB with loop-through switching",
    0x14: "switch",
    0x15: "switch with loop-through of the supply",
    0x18: "SMATV",
    0x20: "any polariser",
    0x21: "linear polariser (skew)",
    0x30: "any positioner",
    0x31: "azimuth or polar positioner",
    0x32: "elevation positioner",
}
COMMANDS = {
    0x00: "reset",
    0x01: "end the reset",
    0x02: "switch the supply of the device off (standby)",
    0x03: "switch the supply of the device on",
    0x10: "read the status",
    0x11: "read the configuration",
    0x14: "read the switches of port group 0 (committed switch)",
    0x15: "read the switches of port group 1 (uncommitted switch)",
    0x20: "choose the low band",
    0x21: "choose vertical polarisation",
    0x22: "choose satellite position A",
    0x23: "choose switch option A",
    0x24: "choose the high band",
    0x25: "choose horizontal polarisation",
    0x26: "choose satellite position B",
    0x27: "choose switch option B",
    0x38: "write to port group 0 (committed switch)",
    0x39: "write to port group 1 (uncommitted switch)",
    0x5A: "Unicable (EN 50494): choose a channel of the cable",
    0x60: "halt the positioner",
    0x63: "disable the limits of the positioner",
    0x64: "read the status of the positioner",
    0x66: "set the east limit here",
    0x67: "set the west limit here",
    0x68: "drive east",
    0x69: "drive west",
    0x6A: "store a position",
    0x6B: "go to a stored position",
    0x6E: "go to an angle",
    0x6F: "recalculate the stored positions",
}
PARAMETERS = {0x38: (1, 1), 0x39: (1, 1), 0x5A: (2, 2), 0x68: (1, 1), 0x69: (1, 1), 0x6A: (1, 1), 0x6B: (1, 1),
              0x6E: (2, 2), 0x6F: (1, 3)}  # fmt: skip
"""How many bytes of data a command takes, at least and at most; none where it is not here."""
WRITE_COMMITTED, WRITE_UNCOMMITTED, POSITIONER_STATUS = 0x38, 0x39, 0x64
DRIVES = (0x68, 0x69)
STORE, GO_TO_STORED, GO_TO_ANGLE = 0x6A, 0x6B, 0x6E
COMMITTED_BITS = (
    ("position", ("A", "B"), 2),
    ("option", ("A", "B"), 3),
    ("", ("vertical", "horizontal"), 1),
    ("", ("low band", "high band"), 0),
)
"""A flag of the committed switch: its name, what it is cleared and set, and its bit; four bits up is what clears it."""
POSITIONER_BITS = (
    (7, "move completed"),
    (6, "limits enabled"),
    (5, "last moved west"),
    (4, "running"),
    (3, "a software limit was reached"),
    (2, "no power for the motor"),
    (1, "a hardware switch is active"),
    (0, "position reference lost"),
)
