"""A stand-in for the engine of the setup: eleven steps in a state to show, and notes of what was asked of it."""

from __future__ import annotations

from dataclasses import replace

from birdcage.base.config import Settings
from birdcage.detection.probe import BaudFinding, Saw
from birdcage.setup.case import Case
from birdcage.setup.causes import find_causes
from birdcage.setup.step import AreaNotClear, Choice, Field, Mark, NoSuchChoice, StepView
from birdcage.station.known import PortInfo, SystemFacts
from birdcage.station.state import LinkPhase, LinkState

DONE, TODO, SKIPPED, LATER, FAILED = Mark.DONE, Mark.TODO, Mark.SKIPPED, Mark.LATER, Mark.FAILED

STEPS = (
    StepView(1, "link", "Link", DONE, "ttyUSB0, FTDI, 115200 8N1, answers in 12 ms",
             ("A dish answers on /dev/ttyUSB0.",), (Choice("keep", "enter", "Use this port"),), page="console"),
    StepView(2, "dish", "Dish", DONE, "Carryout G2 02.02.48", ("Asking the dish.",), page="system"),
    StepView(3, "search", "TV search off", DONE, "off: NVS 20 TRUE, saved (was FALSE; backup nvs-1158.txt)",
             ("The dish's own TV search moves it.",), page="console"),
    StepView(4, "home", "Home", TODO, "not homed: its position is unknown",
             ("Turns through its whole range, runs into its end stops, up to 30 s. Keep its swing clear.",
              "Homing can't be stopped: keep a hand on the 12 V switch."),
             (Choice("home", "enter", "Area is clear: home", moves=True),), page="control"),
    StepView(5, "feed", "Feed", TODO, "",
             ("Which feed is fitted? Frequencies and offsets come from it.",),
             (Choice("stock", "enter", "Stock LNB, 12.2 to 12.7 GHz, beam 5.5° x 5.5° theory"),
              Choice("feed-1", "1", "L-band helix"),
              Choice("other", "o", "Another feed", fields=(
                  Field("name", "name", hint="L-band helix"), Field("band", "band", "", "1670 to 1710 MHz"),
                  Field("beam_deg", "beam", "deg", "2.0 x 2.9; empty: theory"),
                  Field("lo_hz", "LO", "MHz", "9750; empty for none"),
                  Field("az_offset_deg", "az offset", "deg", "beam clockwise of the dish's axis", "0"),
                  Field("el_offset_deg", "el offset", "deg", "beam above the dish's axis", "0"),
                  Field("stow", "stow allowed", "", "y or n", "n"))))),
    StepView(6, "limits", "Limits", TODO, "el 18.00 to 65.00 (read from the dish); cable -423 to +23",
             ("Does your coax, a wall or the tripod stop it sooner? The narrower limit counts.",),
             (Choice("accept", "enter", "Take the limits as they are"),)),
    StepView(7, "direction", "Direction", TODO, "",
             ("It turned 5° in azimuth: seen from above, did it turn clockwise?",),
             (Choice("yes", "y", "Yes", moves=True), Choice("no", "n", "No", moves=True)), page="control"),
    StepView(8, "level", "Level", SKIPPED, "",
             ("Lay a phone with a level on the base plate.",
              "Better than typing: put wedges under it until it is level."),
             (Choice("typed", "enter", "Type pitch and roll", fields=(
                 Field("pitch_deg", "pitch", "deg", "front of the base up is +"),
                 Field("roll_deg", "roll", "deg", "right side down is +"))),)),
    StepView(9, "place", "Location, clock", TODO, "", ("Where does the dish stand?",),
             (Choice("locator", "enter", "Use this locator", fields=(Field("locator", "locator", hint="JO21JV"),)),
              Choice("degrees", "d", "Use these degrees", fields=(
                  Field("latitude_deg", "latitude", "deg", "north is +"),
                  Field("longitude_deg", "longitude", "deg", "east is +"))),
              Choice("trust", "c", "The clock of this machine is right"))),
    StepView(10, "north", "North", TODO, "",
             ("Sun now at 189.02° true, elevation 41.20°.",
              "A compass needle would read 186.8° there (declination 2.2° E).",
              "Move the dish until the feed's shadow lies in mid-dish, then mark."),
             (Choice("mark", "enter", "The dish looks at the Sun now: mark"),
              Choice("typed", "t", "Set the offset", fields=(Field("az_offset_deg", "az offset", "deg", "", "0"),))),
             page="control"),
    StepView(11, "first", "First satellite", LATER, "Astra (28.2°E) expected at 151.3 / 27.2",
             ("Searching, peaking and identifying by signal come in a later version.",),
             (Choice("point", "enter", "Point there", moves=True),),
             page="control"),
)  # fmt: skip

FINDINGS = (
    BaudFinding(57600, Saw.GARBAGE, "..x.", 34, 0.7), BaudFinding(115200, Saw.SILENCE, "", 0, 0.7),
    BaudFinding(9600, Saw.ECHO, "", 1, 0.7),
)  # fmt: skip


class Engine:
    """Says `steps`, and notes each call in `asked`."""

    begin_anew = ""

    def __init__(self, current="home", steps=STEPS, causes=()):
        self.current, self._steps, self._causes = current, list(steps), causes
        self.settings = Settings()
        self.area_clear = self.finished = False
        self.asked, self.ticks = [], 0
        self.refusal = None

    def steps(self):
        return tuple(self._steps)

    def change(self, name, **changes):
        self._steps = [replace(step, **changes) if step.name == name else step for step in self._steps]

    def causes(self):
        return self._causes

    def clear(self):
        self.area_clear = True

    def choose(self, step, choice, values=()):
        chosen = next(each for view in self._steps if view.name == step for each in view.choices if each.name == choice)
        if self.refusal:
            raise NoSuchChoice(self.refusal)
        if chosen.moves and not self.area_clear:
            raise AreaNotClear("not clear")
        self.asked.append((step, choice, dict(values)))

    def skip(self, step):
        self.asked.append(("skip", step))

    def back(self):
        self.asked.append(("back",))
        names = [step.name for step in self._steps]
        self.current = names[max(names.index(self.current) - 1, 0)]

    def go(self, step):
        self.asked.append(("go", step))
        self.current = step

    def tick(self):
        self.ticks += 1


def mute():
    """A port that does not answer, after the probe, on a machine with two hindrances."""
    system = SystemFacts("/dev/ttyUSB0", "dialout", False, False, True, True)
    ports = (PortInfo("/dev/ttyUSB0", None, "FTDI", "0403:6001", "A1", "1-1"),)
    link = LinkState(LinkPhase.SILENT, detail="no prompt: power off, cable out at the dish, or deadlocked")
    causes = find_causes(Case("/dev/ttyUSB0", link, FINDINGS, system, ports, 115200))
    engine = Engine("link", causes=causes)
    engine.change(
        "link", mark=FAILED, evidence="/dev/ttyUSB0 opens. No dish answers at 57600 baud.",
        words=(link.detail, "Choose the port of the RS-422 adapter. Nothing is sent to the others.",
               "Seen: 57600: 34 bytes, garbage; 115200: silence; 9600: own echo.",
               *(f"{cause.title}: {cause.what_to_do}" for cause in causes[:3])),
        choices=(Choice("probe", "p", "Look at other speeds"), Choice("port-1", "1", "/dev/ttyUSB0, FTDI"),
                 Choice("other", "t", "Type a port", fields=(
                     Field("port", "port", hint="/dev/ttyUSB0, COM4, socket://host:port", value="/dev/ttyUSB0"),
                     Field("baud", "speed", "baud", "empty: the firmware's own")))),
    )  # fmt: skip
    for step in STEPS[1:]:
        engine.change(step.name, mark=TODO if step.mark is not LATER else LATER, evidence="")
    return engine


def busy():
    engine = Engine("home")
    engine.change("home", busy="homing; cut the 12 V to stop it", choices=())
    return engine


def finished():
    engine = Engine("first")
    engine.finished = True
    for step in STEPS:
        if step.mark is TODO:
            engine.change(step.name, mark=DONE, evidence=step.evidence or "as answered, 2026-03-20T12:00Z")
    return engine


ENGINES = {
    "home": Engine, "mute": mute, "busy": busy, "finished": finished,
    **{step.name: (lambda name=step.name: Engine(name)) for step in STEPS if step.name != "home"},
}  # fmt: skip
