"""The Network tab: who has control of the dish now, who may take it, and how it is stopped from elsewhere."""

from __future__ import annotations

from birdcage_tui.canvas import Cells
from birdcage_tui.cell_text import wrap
from birdcage_tui.pane import Pane
from birdcage_tui.track.pursuing import pursuit_of
from birdcage_tui.view import YOU, View

OTHERS = (
    ("birdcage stop", "stops the dish from any terminal of this machine, whoever has control."),
    ("birdcage track", "tracks a target without this app. Close the app first: only one program can use the port."),
)
TAKING = (
    "An arrow or go-to takes control when it is free or the tracker has it. Other programs keep it. "
    "Anyone can press STOP."
)
LATER = (
    "Not in this version. A later version brings the server for Gpredict, Look4Sat and others, with a list of who "
    "may connect."
)


def rows(view: View) -> list[tuple[str, str, str]]:
    """Return (label, ink, words) of what is known."""
    state = view.state
    holder = state.holder
    control = "free" if holder is None else f"{holder}, at this terminal" if holder == YOU else holder
    found = [("Control", "strong" if holder else "dim", f"{control[:1].upper()}{control[1:]}.")]
    held = state.held
    if held is not None:
        ignored = f" Refused {held.next_holder} {held.ignored} times." if held.next_holder else ""
        found.append(("Held", "warn", f"by {held.by} since {held.utc:%H:%M:%S}Z.{ignored} Enter releases it."))
    pursuit = pursuit_of(view)
    if pursuit is not None:
        found.append(("Following", "text", f"{pursuit.plan.aim.name}, for {pursuit.holder}."))
    found.append(("Taking it", "text", TAKING))
    found.append(("Port", "text", f"{state.port.split('?')[0] or '--'}: one program at a time can open it."))
    return found


class NetworkPane(Pane):
    """Words in two columns; at the end what this version does not have."""

    HELP = "Who controls the dish, and what else can stop or move it."

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
