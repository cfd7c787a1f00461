"""The plugs of the dishes of one maker, and the adapters that were used with them.

`docs/wiring.md` names the sources.
"""

from __future__ import annotations

from birdcage.rotator.wiring import Adapter, Connector, Drawing, Pin

RJ_25 = (
    Pin(1, "GND", "GND"),
    Pin(2, "T/R-", "TB"),
    Pin(3, "T/R+", "TA"),
    Pin(4, "RXD-", "RB"),
    Pin(5, "RXD+", "RA"),
    Pin(6, "not used", ""),
)
"""The contacts of both dishes that have such a plug."""
OF_RJ_25 = "The READMEs of Gabe Emerson KL1FI for both dishes (Travler_Rotor, Carryout-Rotor), which agree."
BOTH_PAIRS = "Connect both pairs, T/R and RXD, to a 4-wire adapter."

CARRYOUT_G2 = Connector(
    "g2",
    "Carryout G2",
    "RJ-12 (6P6C)",
    Drawing.CLIP_AWAY,
    "RS-422, two pairs, 115200 baud 8N1",
    (
        Pin(1, "GND", "GND", "white"),
        Pin(2, "TX-", "TB", "black"),
        Pin(3, "TX+", "TA", "red"),
        Pin(4, "RX-", "RB", "green"),
        Pin(5, "RX+", "RA", "yellow"),
        Pin(6, "not used", "", "blue"),
    ),
    "The drawing of Chris Davidson, who runs a G2 with it (winegard-sky-scan, docs/wiring_guide.png). The Trav'ler "
    "has the same order.",
    (
        "Supply: read its label. The voltage is not documented.",
        "At 9600, 19200, 38400 and 57600 baud a G2 is silent.",
    ),
)

TRAVLER = Connector(
    "travler",
    "Trav'ler (LG-2112)",
    'RJ-25 (6P6C), the port "Factory Only" of the indoor unit',
    Drawing.TIP_UP,
    "RS-485/422, two pairs, 57600 baud 8N1",
    RJ_25,
    OF_RJ_25,
    (
        "Supply: 12 V DC (RP-SK87) or about 50 V DC. Read its label.",
        BOTH_PAIRS,
    ),
    starts_in_min=15,
)

CARRYOUT_2003 = Connector(
    "carryout",
    "Carryout of 2003",
    "RJ-25 (6P6C), on the control board under the radome",
    Drawing.TIP_UP,
    "RS-485/422, two pairs, 57600 baud 8N1",
    RJ_25,
    OF_RJ_25,
    (
        "Supply: 12 V DC, at least 1 A. Read its label.",
        BOTH_PAIRS,
        "It has no limit switches: at power-up its motors run into their end stops, and grind loudly.",
        "Homing and TV search take 10 to 15 minutes from power-up. No known command ends them.",
        "Leave its tracking enabled (menu nvs): without it the dish does not home either.",
        "No known command stops it: keep the 12 V switch in reach.",
    ),
    starts_in_min=15,
)

TRAVLER_PRO = Connector(
    "pro",
    "Trav'ler Pro (SK2DISH)",
    "USB A, at the rear of the indoor unit; cable USB A to A",
    Drawing.USB,
    "USB CDC (/dev/ttyACM0); the baud rate does not count",
    (),
    "The README of Gabe Emerson KL1FI (Travler-Pro-Rotor).",
    (
        "The rear socket only.",
        "No adapter, no pairs to swap: what a wrong wire does elsewhere does not happen here.",
        "birdcage never opens such a port at 1200 baud: many boards restart into their loader at that rate.",
    ),
)

SH_U11 = Adapter(
    "DSD TECH SH-U11, USB to RS-422 (FTDI FT232R)",
    "Carryout G2",
    "Five wires, ground included. FTDI chips carry a serial number: birdcage finds the port again by it.",
)
DTECH = Adapter(
    "USB to RS-232, then DTECH RS-232 to RS-485/422",
    "Trav'ler, Carryout of 2003",
    "Connect the T/R pair and the RXD pair. If it has several TTL levels, set 5 V.",
)
ESP32 = Adapter(
    "ESP32 with DIYables RS-422 module (MAX490)",
    "Carryout G2",
    "A bridge to Wi-Fi. The module speaks 5 V, the ESP32 takes 3.3 V: divide what goes into RX2. "
    "docs/wiring.md tells how.",
)
