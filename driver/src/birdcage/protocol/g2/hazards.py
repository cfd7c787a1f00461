"""What the lines of the Carryout G2's console do (docs/reference/g2-commands.md; docs/reference/g2.md, *Hazards*)."""

from __future__ import annotations

import re

from birdcage.protocol.g2.hazard_rows import ALL, DEADLOCK, WHERE, harmless, moves, rows, ruins, setting, streams
from birdcage.protocol.g2.model import DIALECT
from birdcage.protocol.g2.motor_hazards import MOTOR_ROWS
from birdcage.protocol.hazard import Hazard, HazardTable
from birdcage.rotator.verdict import Grade

MENUS = frozenset(DIALECT.prompts)
SUBMENUS = MENUS - {"root"}

_EVERYWHERE = (
    *harmless(MENUS, "", r"\?", r"help( \S+)?"),
    *harmless(SUBMENUS, "q"),
)
_ROOT = (
    *harmless("root", "|".join(sorted(SUBMENUS))),
    *ruins("root", "At the root menu, `q` may end the shell: the dish then stays silent until a power cycle.", "q"),
    Hazard(
        frozenset({"root"}),
        re.compile(".*q.*"),
        Grade.RUINS,
        "A byte lost on the way could leave a bare `q` of this line, which may end the shell until a power cycle.",
        loose=True,
    ),
    *ruins(
        "root",
        "Folds the dish flat by itself. A feed that is not the stock one may be crushed, and nothing stops it.",
        "stow( .*)?",
        forgets=WHERE,
        takes_s=60.0,
    ),
    *rows(
        "root os",
        Grade.MOVES,
        "Restarts the dish: it homes and may begin its TV search, or it comes up not homed.",
        "reboot( .*)?",
        forgets=ALL,
        takes_s=180.0,
        restarts=True,
    ),
)
_A3981 = (
    *harmless("a3981", "cm|diag|sm|ss|st"),
    *setting(
        "a3981",
        "Clears the fault flags of the motor drivers: what they tell is lost, and a motor that had switched off may "
        "be driven again.",
        "reset( .*)?",
    ),
)
_ADC = (
    *harmless("adc", "bdid|bdrevid|rssi"),
    *streams("adc", "m"),
    *ruins("adc", f"Sweeps the azimuth. {DEADLOCK}", "scan( .*)?", forgets=WHERE, takes_s=120.0, unhomed=True),
    *moves("adc", "Sweeps the azimuth by itself; nothing here stops it for sure.", "scan( .*)?", takes_s=120.0),
)
_DVB = (
    *harmless("dvb", "config|dis|freqs|man|qls|stats", "ovraddr|pretx|rrto|tdthresh"),
    *harmless("dvb", "di2conf|di2id|di2rcs|di2stat", takes_s=2.0),
    *harmless("dvb", "diag|ls", takes_s=10.0),
    *harmless("dvb", r"rssi (?P<reads>\d{1,2})"),
    *setting("dvb", "The dish ignores everything until it has finished: no STOP reaches it.",
              r"rssi (?P<reads>\d{3,4})"),
    *streams("dvb", "agc|lnbv|nid|snr"),
    *setting("dvb", "Puts all settings of the tuner back to the factory's: yours are lost.", "def( .*)?"),
    *setting(
        "dvb",
        "Switches the LNB supply from 18 V to 13 V: the polarisation changes. Anything else on that cable may be "
        "damaged.",
        "lnbdc( .*)?",
    ),
    *setting("dvb", "Changes a parameter of the tuner's channel.", "e .+", r"t( \S+)?"),
    *setting("dvb", "Changes how the tuner searches; what it hears afterwards may differ.",
              "srch_mode( .*)?", "shuf( .*)?", "range( .*)?", "(tabto|to)( .*)?", takes_s=10.0),
    *setting("dvb", "Switches the tuner's power or a multi-switch: the signal may vanish.", "(pwr|msw)( .*)?"),
    *setting("dvb", "Builds the table of transponders anew.", "tablex?( .*)?", takes_s=60.0),
    *setting(
        "dvb", "Changes how the tuner talks to switches and LNB.", "(ovraddr|pretx|rrto|tdthresh) .+"
    ),
    *setting("dvb", "Sends DiSEqC to the LNB and its switches: polarisation or input may change.",
              "(send|di2cs|di2sc)( .*)?", takes_s=2.0),
    *moves(
        "dvb", "Begins the dish's own TV search: it moves by itself until it has found something.", "srch( .*)?",
        forgets=WHERE | {"search"}, takes_s=60.0,
    ),
)  # fmt: skip
_EEPROM = (
    *harmless("eeprom", r"ee \S+"),
    *ruins("eeprom", "Writes the processor's own memory: what stood there is lost for good.", "ee .+ .+"),
    *ruins("eeprom", "Marks an entry of the processor's memory as invalid: it is lost for good.", "inv( .*)?"),
    *ruins("eeprom", "Puts the processor's memory back to the factory's: what stood there is lost.", "def( .*)?"),
)
_NVS_FORGETS = frozenset({"limits", "search", "settings"})
_NVS = (
    *harmless("nvs", r"d( \S+)?", takes_s=10.0),
    *harmless("nvs", r"e( \S+)?"),
    *setting(
        "nvs",
        "Switches the dish's own TV search, and with it homing: whether it moves by itself at the next start. `s` "
        "makes it permanent.",
        "e 20 .+",
        forgets=_NVS_FORGETS,
    ),
    *setting(
        "nvs",
        "Changes the dish's own elevation limits or home; `s` makes it permanent. It may then run into its stops.",
        "e 10[123] .+",
        forgets=_NVS_FORGETS,
    ),
    *setting(
        "nvs",
        "Changes a setting of the dish; `s` makes it permanent. Limits, speeds and steps stand here too: a wrong one "
        "can drive the dish into its stops.",
        "e .+ .+",
        forgets=_NVS_FORGETS,
    ),
    *setting(
        "nvs",
        "Writes all changed settings into flash, wrong ones too: they apply from the next start.",
        "s( .*)?",
        forgets=_NVS_FORGETS,
        takes_s=10.0,
    ),
)
_OTHERS = (
    *harmless("os", "id"),
    *harmless("dipswitch", "dipswitch"),
    *harmless("latlon", "l .+"),
    *harmless("gpio", r"dir \S+", r"r \S+"),
    *harmless("gpio", "regs", takes_s=5.0),
    *ruins(
        "gpio", "Drives a pin of the processor: that can switch, upset or destroy what is connected to it.", "w( .*)?"
    ),
    *harmless("peak", "ts"),
    *setting("peak", "Switches the LNB between 13 V and 18 V while it measures.", "rssits( .*)?", takes_s=10.0),
    *setting("peak", "Drives the line of the set-top box: switches and LNB may change over.", "stb( .*)?"),
    *moves("peak", "Searches for the peak of the signal by itself: it moves the dish.", "pw( .*)?", takes_s=60.0),
    *moves("peak", "Sweeps an axis around the peak by itself: it moves the dish.", "pxy1( .*)?", takes_s=60.0),
    *moves("peak", "Measures at the peak; it may move the dish.", "psnr( .*)?", takes_s=60.0),
)
HAZARDS = HazardTable(
    rows=_EVERYWHERE + _ROOT + _A3981 + _ADC + _DVB + _EEPROM + _NVS + _OTHERS + MOTOR_ROWS,
    unlisted={
        "": "Undocumented command. It may change a setting, or worse.",
        "nvs": "Not a command of this menu. The dish seems to read such a line as a query for its next setting.",
    },
)
