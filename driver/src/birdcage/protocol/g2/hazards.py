"""What the lines of the Carryout G2's console do (reference sections 7.3 and 7.8, source document 001)."""

from __future__ import annotations

import re

from birdcage.protocol.g2.model import DIALECT
from birdcage.protocol.hazard import Grade, Hazard, HazardTable

MENUS = frozenset(DIALECT.prompts)
SUBMENUS = MENUS - {"root"}

_WHERE = frozenset({"position", "turn"})
_REFERENCE = frozenset({"position", "turn", "homed"})
_ALL = frozenset({"position", "turn", "homed", "limits", "search", "settings"})
_DEADLOCK = (
    "The dish is not known to be homed: its target may be 2147483647, and its shell then waits for ever. "
    "Only a power cycle ends that. Home it first."
)
_ONE_AXIS = r"a (?P<axis>[01]) (?P<angle>\S+)"
_BOTH_AXES = r"g (?P<az>\S+) (?P<el>\S+)"
_HOMING = "Runs the axis into its stop to find its reference. Nothing stops that but cutting the power."
_UNGUARDED = "The limits that birdcage keeps do not hold for a raw line."


def _rows(
    menus: str | frozenset[str],
    grade: Grade,
    consequence: str,
    *patterns: str,
    forgets: frozenset[str] = frozenset(),
    takes_s: float = 0.0,
    streams: bool = False,
    homes: tuple[int, ...] = (),
    restarts: bool = False,
    unhomed: bool = False,
    releases: bool = False,
) -> tuple[Hazard, ...]:
    where = frozenset(menus.split()) if isinstance(menus, str) else menus
    return tuple(
        Hazard(
            where,
            re.compile(pattern),
            grade,
            consequence,
            forgets,
            takes_s,
            streams,
            homes,
            restarts,
            unhomed,
            releases,
        )
        for pattern in patterns
    )


def _harmless(menus: str | frozenset[str], *patterns: str, takes_s: float = 0.0) -> tuple[Hazard, ...]:
    return _rows(menus, Grade.HARMLESS, "", *patterns, takes_s=takes_s)


def _streams(menu: str, *patterns: str) -> tuple[Hazard, ...]:
    return _rows(menu, Grade.HARMLESS, "", *patterns, streams=True)


def _setting(
    menus: str, consequence: str, *patterns: str, forgets: frozenset[str] = frozenset(), takes_s: float = 0.0
) -> tuple[Hazard, ...]:
    return _rows(menus, Grade.SETTING, consequence, *patterns, forgets=forgets, takes_s=takes_s)


def _moves(
    menus: str,
    consequence: str,
    *patterns: str,
    forgets: frozenset[str] = _WHERE,
    takes_s: float = 0.0,
    homes: tuple[int, ...] = (),
) -> tuple[Hazard, ...]:
    return _rows(menus, Grade.MOVES, consequence, *patterns, forgets=forgets, takes_s=takes_s, homes=homes)


def _ruins(
    menus: str | frozenset[str],
    consequence: str,
    *patterns: str,
    forgets: frozenset[str] = frozenset(),
    takes_s: float = 0.0,
    unhomed: bool = False,
) -> tuple[Hazard, ...]:
    return _rows(
        menus, Grade.RUINS, consequence, *patterns, forgets=forgets, takes_s=takes_s, unhomed=unhomed
    )  # fmt: skip


_EVERYWHERE = (
    *_harmless(MENUS, "", r"\?", r"help( \S+)?"),
    *_harmless(SUBMENUS, "q"),
)
_ROOT = (
    *_harmless("root", "|".join(sorted(SUBMENUS))),
    *_ruins("root", "At the root menu, `q` may end the shell: the dish then answers nothing until a power cycle.", "q"),
    Hazard(
        frozenset({"root"}),
        re.compile(".*q.*"),
        Grade.RUINS,
        "A byte lost on the way could leave a bare `q` of this line, which may end the shell until a power cycle.",
        loose=True,
    ),
    *_ruins(
        "root",
        "Folds the dish flat by itself. A feed that is not the stock one may be crushed, and nothing stops it.",
        "stow( .*)?",
        forgets=_WHERE,
        takes_s=60.0,
    ),
    *_rows(
        "root os",
        Grade.MOVES,
        "Restarts the dish: it homes and may begin its TV search, or it comes up without knowing where it is.",
        "reboot( .*)?",
        forgets=_ALL,
        takes_s=180.0,
        restarts=True,
    ),
)
_A3981 = (
    *_harmless("a3981", "cm|diag|sm|ss|st"),
    *_setting(
        "a3981",
        "Clears the fault flags of the motor drivers: what they tell is lost, and a motor that had switched off may "
        "be driven again.",
        "reset( .*)?",
    ),
)
_ADC = (
    *_harmless("adc", "bdid|bdrevid|rssi"),
    *_streams("adc", "m"),
    *_ruins("adc", f"Sweeps the azimuth. {_DEADLOCK}", "scan( .*)?", forgets=_WHERE, takes_s=120.0, unhomed=True),
    *_moves("adc", "Sweeps the azimuth by itself; nothing here stops it for sure.", "scan( .*)?", takes_s=120.0),
)
_DVB = (
    *_harmless("dvb", "config|dis|freqs|ls|man|qls|stats", "di2conf|di2id|di2rcs|di2stat"),
    *_harmless("dvb", "ovraddr|pretx|rrto|tdthresh"),
    *_harmless("dvb", "diag", takes_s=10.0),
    *_harmless("dvb", r"rssi (?P<reads>\d{1,2})"),
    *_setting("dvb", "Until it has read so often the dish listens to nothing: no STOP reaches it.",
              r"rssi (?P<reads>\d{3,4})"),
    *_streams("dvb", "agc|lnbv|nid|snr"),
    *_setting("dvb", "Puts all settings of the tuner back to the factory's: yours are lost.", "def( .*)?"),
    *_setting(
        "dvb",
        "Switches the supply of the LNB: the polarisation changes (18 V to 13 V), and what is not an LNB on that cable "
        "may be damaged.",
        "lnbdc( .*)?",
    ),
    *_setting("dvb", "Changes a parameter of the tuner's channel.", "e .+", r"t( \S+)?"),
    *_setting("dvb", "Changes how the tuner searches; what it hears afterwards may differ.",
              "srch_mode( .*)?", "shuf( .*)?", "range( .*)?", "(tabto|to)( .*)?"),
    *_setting("dvb", "Switches the tuner's power or a multi-switch: the signal may vanish.", "(pwr|msw)( .*)?"),
    *_setting("dvb", "Builds the table of transponders anew.", "tablex?( .*)?", takes_s=60.0),
    *_setting(
        "dvb", "Changes how the tuner talks to switches and LNB.", "(ovraddr|pretx|rrto|tdthresh) .+"
    ),
    *_setting("dvb", "Sends DiSEqC to the LNB and its switches: polarisation or input may change.",
              "(send|di2cs|di2sc)( .*)?"),
    *_moves(
        "dvb", "Begins the dish's own TV search: it moves by itself until it has found something.", "srch( .*)?",
        forgets=_WHERE | {"search"}, takes_s=60.0,
    ),
)  # fmt: skip
_EEPROM = (
    *_harmless("eeprom", r"ee \S+"),
    *_ruins("eeprom", "Writes the processor's own memory: what stood there is lost for good.", "ee .+ .+"),
    *_ruins("eeprom", "Marks an entry of the processor's memory as invalid: it is lost for good.", "inv( .*)?"),
    *_ruins("eeprom", "Puts the processor's memory back to the factory's: what stood there is lost.", "def( .*)?"),
)
_NVS_FORGETS = frozenset({"limits", "search", "settings"})
_NVS = (
    *_harmless("nvs", r"d( \S+)?", takes_s=10.0),
    *_harmless("nvs", r"e( \S+)?"),
    *_setting(
        "nvs",
        "Switches the dish's own TV search, and with it homing: whether it moves by itself at the next start. `s` "
        "makes it permanent.",
        "e 20 .+",
        forgets=_NVS_FORGETS,
    ),
    *_setting(
        "nvs",
        "Changes the dish's own elevation limits or home; `s` makes it permanent. It may then run into its stops.",
        "e 10[123] .+",
        forgets=_NVS_FORGETS,
    ),
    *_setting(
        "nvs",
        "Changes a setting of the dish; `s` makes it permanent. Limits, speeds and steps stand here too: a wrong one "
        "can drive the dish into its stops.",
        "e .+ .+",
        forgets=_NVS_FORGETS,
    ),
    *_setting(
        "nvs",
        "Writes all changed settings into flash: they hold from the next start on, also the wrong ones.",
        "s( .*)?",
        forgets=_NVS_FORGETS,
        takes_s=10.0,
    ),
)
_OTHERS = (
    *_harmless("os", "id"),
    *_harmless("dipswitch", "dipswitch"),
    *_harmless("latlon", "l .+"),
    *_harmless("gpio", r"dir \S+", r"r \S+"),
    *_harmless("gpio", "regs", takes_s=5.0),
    *_ruins("gpio", "Drives a pin of the processor: that can switch, upset or destroy what hangs on it.", "w( .*)?"),
    *_harmless("peak", "ts"),
    *_setting("peak", "Switches the LNB between 13 V and 18 V while it measures.", "rssits( .*)?", takes_s=10.0),
    *_setting("peak", "Drives the line of the set-top box: switches and LNB may change over.", "stb( .*)?"),
    *_moves("peak", "Searches for the peak of the signal by itself: it moves the dish.", "pw( .*)?", takes_s=60.0),
    *_moves("peak", "Sweeps an axis around the peak by itself: it moves the dish.", "pxy1( .*)?", takes_s=60.0),
    *_moves("peak", "Measures at the peak; whether it moves the dish is not known.", "psnr( .*)?", takes_s=60.0),
)
_CURRENT = (
    *_moves(
        "mot step",
        "Puts the current on the motors: they may jerk, and after a release the dish is not where it says.", "e( .*)?",
    ),
    *_rows(
        "mot step",
        Grade.MOVES,
        "Takes the current off the motors: the dish may fall under its own weight, and its position is then unknown.",
        "r( .*)?", forgets=_REFERENCE, releases=True,
    ),
)  # fmt: skip
_MOT = (
    *_harmless("mot", "a|ela2s .+|elminmaxhome|els2a .+|l|life|ma|motorlife|mv|p|pid|v"),
    *_moves("mot", f"Moves an axis at once. {_UNGUARDED}",
            r"a (?P<axis>1) (?P<angle>\S+)", forgets=frozenset({"position"})),
    *_moves("mot", f"Moves an axis at once. {_UNGUARDED}", _ONE_AXIS, "a .+"),
    *_moves("mot", f"Moves both axes at once. {_UNGUARDED}", _BOTH_AXES, "g( .*)?"),
    *_ruins("mot", f"Moves the dish. {_DEADLOCK}",
            _ONE_AXIS, "a .+", _BOTH_AXES, "g( .*)?", "motorboth( .*)?", forgets=_WHERE, unhomed=True),
    *_ruins("mot", f"Sweeps the azimuth. {_DEADLOCK}",
            r"azscan\S*( .*)?", forgets=_WHERE, takes_s=120.0, unhomed=True),
    *_moves("mot", "Sweeps the azimuth by itself, up to minutes; nothing stops it for sure.",
            r"azscan\S*( .*)?", takes_s=120.0),
    *_moves("mot", _HOMING, "h 0", forgets=_REFERENCE, takes_s=15.0, homes=(0,)),
    *_moves("mot", _HOMING, "h 1", forgets=_REFERENCE, takes_s=15.0, homes=(1,)),
    *_moves("mot", _HOMING, r"h \*", forgets=_REFERENCE, takes_s=30.0, homes=(0, 1)),
    *_moves("mot", _HOMING, "h( .*)?", forgets=_REFERENCE, takes_s=30.0),
    *_moves("mot", "Moves both motors at the same time, as a test of its own.", "motorboth( .*)?", takes_s=30.0),
    *_moves("mot", "Drives a motor until it stalls, as a test: it runs into whatever is in its way.",
            "sd( .*)?", takes_s=30.0),
    *_moves("mot", "Spins a motor for a time, whatever the limits and the cable.",
            "vms( .*)?", takes_s=30.0),
    *_ruins("mot", "Tells the dish that it stands elsewhere: every angle and limit is then wrong, until it is homed.",
            "sp( .*)?", forgets=_REFERENCE),
    *_ruins("mot", "Tells the dish that its cable is turned otherwise: it may then wind the cable until it tears.",
            "sw( .*)?", forgets=_REFERENCE),
    *_ruins("mot", "Switches the protection of the cable off: the dish may then wind it until it tears.",
            "w( .*)? off( .*)?"),
    *_setting("mot", "Switches the protection of the cable.", "w( .*)?"),
    *_setting("mot step", "Changes how hard the motors are driven: too much loses steps, and angles are then wrong.",
              "(ma|mv|pid) .+", forgets=frozenset({"settings"})),
)  # fmt: skip
_STEP = (
    *_harmless("step", "ma|mv|pid"),
    *_ruins("step", f"Moves a motor. {_DEADLOCK}", "p( .*)?", forgets=_WHERE, unhomed=True),
    *_moves("step", "Sends a motor to a count of steps, whatever the limits and the cable.", "p( .*)?"),
    *_ruins("step", "Spins a motor without end: it winds the cable until it tears, or runs into a stop.",
            "v( .*)?", forgets=_WHERE),
)  # fmt: skip

HAZARDS = HazardTable(
    rows=_EVERYWHERE + _ROOT + _A3981 + _ADC + _DVB + _EEPROM + _NVS + _OTHERS + _CURRENT + _MOT + _STEP,
    unlisted={
        "": "Nobody has written down what this does: take it for a change of a setting, or worse.",
        "nvs": "No command of this menu: the dish takes such a line as a question for its next setting, as far as "
        "is known.",
    },
)
