"""The settings memory of a G2, as far as sources print it."""

from __future__ import annotations

HEAD = (
    "Num  Name                         Current      Saved      Default\n"
    "---- --------------------------  ----------  ----------  ----------\n"
)
FACTORY = {
    0: ("Log ID's", "0x00000007"), 1: ("Log Device", "0x00000001"), 2: ("Debug 2nd Console Port", "0"),
    3: ("Debug 2nd Packet Port", "0"), 4: ("Debug Port Connection", "0"), 16: ("Pitch Deadband", "0.00"),
    17: ("Roll Deadband", "0.00"), 18: ("Yaw Deadband", "0.00"), 20: ("Disable Tracker Proc?", "FALSE"),
    21: ("Tracker Proc Run Mode", "0"), 22: ("Conical Alpha Az", "200"), 23: ("Conical Alpha El", "200"),
    24: ("Conical Radius", "1.00"), 25: ("Conical Count Max", "20"), 26: ("Conical Test Drift", "+0"),
    27: ("Circle RPM", "120"), 28: ("Circle Pts/Rev", "6"), 32: ("Conical Az Clamp", "8.00"),
    33: ("Conical El Clamp", "8.00"), 35: ("Motor Pts/Rev", "72"), 36: ("Circle Az Radius", "1.00"),
    37: ("Circle El Radius", "1.00"), 38: ("Sleep Mode Timer Secs", "420"), 40: ("Motor Type", "0"),
    41: ("Satellite Scan Velocity", "55.00"), 80: ("AZ Max Vel", "65.00"), 81: ("AZ Max Accel", "400.00"),
    83: ("AZ Steps/Rev", "40000"), 85: ("EL Max Vel", "45.00"), 88: ("EL Steps/Rev", "24960"),
    101: ("Minimum Elevation Angle", "18.00"), 102: ("Maximum Elevation Angle", "65.00"),
    103: ("Elevation Home Angle", "65.00"), 112: ("Disable Dipswitch?", "FALSE"), 113: ("Dipswitch Value", "101"),
}  # fmt: skip


class Nvs:
    """Rows in RAM and in flash."""

    def __init__(self, changed: dict[int, str]) -> None:
        self.flash = {index: value for index, (_name, value) in FACTORY.items()} | changed
        self.ram = dict(self.flash)

    def row(self, index: int) -> str:
        name, factory = FACTORY[index]
        return f"{index:3d}) {name:<26}  {self.ram[index]:>10}  {self.flash[index]:>10}  {factory:>10}\n"

    def run(self, words: list[str], line: str) -> str:
        """Carry out one line of the menu."""
        match words:
            case ["d"]:
                return HEAD + "".join(map(self.row, FACTORY))
            case ["d" | "e", index] if self._has(index):
                return HEAD + self.row(int(index)) if words[0] == "d" else self.row(int(index))
            case ["e", index, value] if self._has(index):
                return self._edit(int(index), value)
            case ["s"]:
                self.flash = dict(self.ram)
                return (
                    "    Saving ... \nFlash file flashx:bank0 opened\nFlash sector cache enabled.\nFlash doneSuccess\n"
                )
            case _:
                return self.row(0) if line else ""

    def _has(self, index: str) -> bool:
        return index.isdigit() and int(index) in FACTORY

    def _edit(self, index: int, value: str) -> str:
        name, factory = FACTORY[index]
        before = self.ram[index]
        if factory in ("TRUE", "FALSE"):
            value = "TRUE" if value in ("1", "TRUE", "true") else "FALSE"
        elif "." in factory:
            value = f"{float(value):.2f}"
        self.ram[index] = value
        return f"{index:3d}) {name:<26} {before:>10} .{value:>11}\n"
