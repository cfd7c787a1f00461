"""The G2's settings memory: RAM, flash and factory values (docs/reference/g2-settings.md, *Rows*).

Only the rows that a source quotes are here; the others are holes, as an index that does not exist. With `nvs_rows=all`
every index up to 149 exists: what the others are called is made up, and three lines have a form of their own.
"""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.trk.nvram import Kind, Nvram, NvramSetting

ROWS: dict[int, NvramSetting] = {
    0: NvramSetting("Log ID's", "hex", 7),
    1: NvramSetting("Log Device", "hex", 1),
    2: NvramSetting("Debug 2nd Console Port", "int", 0),
    3: NvramSetting("Debug 2nd Packet Port", "int", 0),
    4: NvramSetting("Debug Port Connection", "int", 0),
    16: NvramSetting("Pitch Deadband", "fixed", 0),
    17: NvramSetting("Roll Deadband", "fixed", 0),
    18: NvramSetting("Yaw Deadband", "fixed", 0),
    20: NvramSetting("Disable Tracker Proc?", "bool", 0),
    21: NvramSetting("Tracker Proc Run Mode", "int", 0),
    22: NvramSetting("Conical Alpha Az", "int", 200),
    23: NvramSetting("Conical Alpha El", "int", 200),
    24: NvramSetting("Conical Radius", "fixed", 1),
    25: NvramSetting("Conical Count Max", "int", 20),
    26: NvramSetting("Conical Test Drift", "signed", 0),
    27: NvramSetting("Circle RPM", "int", 120),
    28: NvramSetting("Circle Pts/Rev", "int", 6),
    32: NvramSetting("Conical Az Clamp", "fixed", 8),
    33: NvramSetting("Conical El Clamp", "fixed", 8),
    35: NvramSetting("Motor Pts/Rev", "int", 72),
    36: NvramSetting("Circle Az Radius", "fixed", 1),
    37: NvramSetting("Circle El Radius", "fixed", 1),
    38: NvramSetting("Sleep Mode Timer Secs", "int", 420),
    40: NvramSetting("Motor Type", "int", 0),
    41: NvramSetting("Satellite Scan Velocity", "fixed", 55),
    80: NvramSetting("AZ Max Vel", "fixed", 65),
    81: NvramSetting("AZ Max Accel", "fixed", 400),
    83: NvramSetting("AZ Steps/Rev", "int", 40000),
    85: NvramSetting("EL Max Vel", "fixed", 45),
    88: NvramSetting("EL Steps/Rev", "int", 24960),
    101: NvramSetting("Minimum Elevation Angle", "fixed", 18),
    102: NvramSetting("Maximum Elevation Angle", "fixed", 65),
    103: NvramSetting("Elevation Home Angle", "fixed", 65),
    112: NvramSetting("Disable Dipswitch?", "bool", 0),
    113: NvramSetting("Dipswitch Value", "int", 101),
    128: NvramSetting("AZ Kp", "fixed", 250),
    129: NvramSetting("AZ Kv", "fixed", 50),
    130: NvramSetting("AZ Ki", "fixed", 0),
    131: NvramSetting("EL Kp", "fixed", 250),
    132: NvramSetting("EL Kv", "fixed", 50),
    133: NvramSetting("EL Ki", "fixed", 0),
}
"""Only 20, 38, 41, 80, 81, 85, 101 to 103 and 128 to 133 change what this dish does; the others are kept and shown.

That 128 to 133 are the gains is noted; their order, names, kind and values are assumed (settings `pid_kp`,
`pid_kv`, `pid_ki`).
"""
AZ_GAINS, EL_GAINS = 128, 131
"""Their first rows: Kp, Kv and Ki follow each other."""


ODD_LINES = {
    142: "142) Serial                     ODU 4711 A",
    143: "143] Calibration date             2026-02-12  2026-02-12",
    144: "144) A name that is far longer than its column           7           7           7",
}
"""Lines with which no other row shares its form (made up)."""
ALL_ROWS = 150


def spare_rows() -> dict[int, NvramSetting]:
    """Return a row for each index that no source quotes."""
    kinds: tuple[Kind, ...] = ("int", "fixed", "hex", "bool", "signed")
    free = (index for index in range(ALL_ROWS) if index not in ROWS and index not in ODD_LINES)
    return {index: NvramSetting(f"Spare {index}", kinds[index % 5], float(index % 2)) for index in free}


def g2_nvram(saved: Mapping[int, float], settings: G2Settings) -> Nvram:
    """Return a memory with the factory's values, but for those `saved` before."""
    shows_all = settings.nvs_rows == "all"
    return Nvram(
        ROWS | (spare_rows() if shows_all else {}), saved,
        takes_hex=settings.nvs_hex, odd_lines=ODD_LINES if shows_all else {},
    )  # fmt: skip
