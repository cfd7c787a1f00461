"""The Network tab: who has control of the dish now, who may take it, and how it is stopped from elsewhere."""

from __future__ import annotations

from birdcage_tui.canvas import Cells
from birdcage_tui.cell_text import wrap
from birdcage_tui.pane import Pane
from birdcage_tui.track.pursuing import pursuit_of
from birdcage_tui.view import YOU, View

OTHERS = (
    ("birdcage stop", "stops it at once, from any terminal of this machine, whoever has control."),
    ("birdcage track", "follows a target without this app; not beside it, for the port has one owner."),
)
TAKING = (
    "A key that moves the dish by hand takes control where nobody has it, and from the tracker; from anybody else it "
    "is refused. STOP is everybody's."
)
LATER = (
    "This version has none. It is the server that Gpredict, Look4Sat and others connect to; a later version brings "
    "it, with a list of who may connect."
)


def rows(view: View) -> list[tuple[str, str, str]]:
    """Return (label, ink, words) of what is known."""
    state = view.state
    holder = state.holder
    control = "nobody" if holder is None else f"{holder}, at this terminal" if holder == YOU else holder
    found = [("Control", "strong" if holder else "dim", f"{control}.")]
    held = state.held
    if held is not None:
        ignored = f" {held.next_holder} was refused {held.ignored} times." if held.next_holder else ""
        found.append(("Held", "warn", f"by {held.by} since {held.utc:%H:%M:%S}Z.{ignored} Enter releases it."))
    pursuit = pursuit_of(view)
    if pursuit is not None:
        found.append(("Following", "text", f"{pursuit.plan.aim.name}, for {pursuit.holder}."))
    found.append(("Taking it", "text", TAKING))
    found.append(("Port", "text", f"{state.port.split('?')[0] or '--'}: one program at a time may have it open."))
    return found


class NetworkPane(Pane):
    """Words in two columns; at the end what this version does not have."""

    HELP = "Who has control of the dish, and what else may stop or move it."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Who may move the dish"

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows, then the commands of a shell."""
        y = 0
        for label, ink, words in rows(view):
            y = self._row(cells, y, label, words, ink)
        y += 1
        cells.put(1, y, "In a shell", "dim")
        y += 1
        for name, words in OTHERS:
            aside = " It does not reach a demo." if view.state.demo and name == "birdcage stop" else ""
            y = self._row(cells, y, name, words + aside, "text", label_ink="strong")
        y += 1
        self._row(cells, y, "rotctld", LATER, "dim")

    @staticmethod
    def _row(cells: Cells, y: int, label: str, words: str, ink: str, label_ink: str = "dim") -> int:
        cells.put(1, y, label, label_ink)
        for line in wrap(words, max(cells.width - 18, 10)):
            cells.put(17, y, line, ink)
            y += 1
        return y
