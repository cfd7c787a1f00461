"""The commands of the Carryout G2, menu by menu (docs/reference/g2-commands.md). Most are noted alone."""

from __future__ import annotations

from birdcage.rotator.raw import CommandDoc

_LISTED = {
    "root": """
        a3981 | | motor drivers
        adc | | analogue readings and a sweep
        dipswitch | | DIP switches
        dvb | | DVB tuner
        eeprom | | the processor's own memory
        gpio | | pins of the processor
        latlon | | where am I, from two satellites
        mot | | motors
        nvs | | settings of the dish
        os | | system
        peak | | peaking and switches
        step | | motors in steps
        help | [<command>] | lists commands
        reboot | | restarts the dish
        stow | | folds the dish flat
        q | | may end the shell until a power cycle
    """,
    "a3981": """
        cm | | current mode of both drivers
        diag | | fault pins of both drivers
        reset | | clears the drivers' fault flags
        sm | | step mode
        ss | | step size: 16 is full, 1 a sixteenth
        st | | torque: HIGH moving, LOW holding
    """,
    "adc": """
        bdid | | board identity
        bdrevid | | board revision
        m | | prints the RSSI until a key
        rssi | | one raw RSSI count
        scan | [<arguments>] | sweeps the azimuth with RSSI, lock and SNR
    """,
    "dipswitch": """
        dipswitch | | reads the switches
    """,
    "dvb": """
        agc | | prints AGC, SNR and NID until a key
        config | | versions of the tuner
        def | | factory settings of the tuner
        diag | | diagnostics of each transponder
        dis | | parameters of the channel
        e | <n> <value> | changes a parameter of the channel
        freqs | | list of frequencies
        lnbdc | odu | LNB supply of 13 V
        lnbv | | prints LNB voltages until a key
        ls | | lock status
        man | | more commands
        msw | | multi-switch
        nid | | prints network IDs until a key
        pwr | | power
        qls | | lock status, short
        range | | range test of the signal
        rssi | <reads> | RSSI, averaged
        shuf | | shuffles transponders
        snr | | prints the SNR until a key
        srch | | begins the TV search
        srch_mode | | mode of the search
        stats | | statistics of reads
        t | <n> | selects a transponder
        table | | builds the table of transponders
        tablex | | builds the longer table
        tabto | | timeout of the table
        to | | timeout
        di2conf | | DiSEqC: configuration of the LNB
        di2cs | | DiSEqC: committed switch
        di2id | | DiSEqC: identity of the LNB
        di2rcs | | DiSEqC: state of the committed switch
        di2sc | | DiSEqC: short circuit test or switch control
        di2stat | | DiSEqC: status of the LNB
        ovraddr | | DiSEqC: address
        pretx | | DiSEqC: delay before sending
        rrto | | DiSEqC: timeout of a reply
        send | <hex> ... | DiSEqC: sends up to 6 bytes
        tdthresh | | DiSEqC: threshold of the tone
    """,
    "eeprom": """
        ee | <index> [<value>] | reads or writes an entry
        inv | <index> | marks an entry as invalid
        def | | factory values
    """,
    "gpio": """
        dir | <pin> | direction of a pin
        r | <pin> | reads a pin
        regs | | reads all pins
        w | <pin> <value> | drives a pin
    """,
    "latlon": """
        l | <p1> <p2> <p3> <p4> | latitude and longitude from the angles of two satellites
    """,
    "mot": """
        a | [<motor> <angle>] | angles; or moves an axis (0 azimuth, 1 elevation)
        azscan | [<az>] [<el>] [<delay>] | sweeps the azimuth
        azscanwxp | [<motor>] [<span>] [<cdeg>] [<transponders>] | sweeps the azimuth through transponders
        e | | current on the motors
        ela2s | <angle> | elevation angle to steps
        elminmaxhome | | elevation limits and home
        els2a | <steps> | elevation steps to angle
        g | <az> <el> | moves both axes
        h | <motor> | homes an axis
        l | | lists the motors
        life | | use of the motors
        ma | | greatest acceleration
        motorboth | | moves both motors as a test
        motorlife | | use of the motors, in detail
        mv | | greatest speed
        p | | raw steps
        pid | [<motor>] [<Kp>] [<Kv>] [<Ki>] | gains
        r | | current off the motors
        sd | | stall detection test
        sp | [<motor>] [<position>] | overwrites the position
        sw | [<motor>] [<position>] | overwrites the turn of the cable
        v | | speeds now
        vms | [<motor>] [<speed>] [<ms>] | spins a motor for a time
        w | [<motor>] [ON/OFF] | protection of the cable
    """,
    "nvs": """
        d | [<index>] | shows all settings, or one
        e | <index> [<value>] | reads or changes a setting
        s | | saves to flash
    """,
    "os": """
        id | | identity of dish and firmware
        reboot | | restarts the dish
    """,
    "peak": """
        pw | | searches the peak of the signal
        psnr | | SNR at the peak
        pxy1 | | sweeps one axis around the peak
        rssits | | RSSI in both polarisations
        stb | | line of the set-top box
        ts | | status of the switch
    """,
    "step": """
        e | | current on the motors
        ma | [<motor>] [<ustep/s/ms>] | greatest acceleration
        mv | [<motor>] [<ustep/s>] | greatest speed
        p | [<motor>] [<steps>] | goes to a count of steps
        pid | [<motor>] [<Kp>] [<Kv>] | gains
        r | | current off the motors
        v | [<motor>] [<ustep/s>] | spins a motor without end
    """,
}
_IN_EACH_SUBMENU = """
        ? | | lists commands
        q | | back to the root menu
"""


def _read(menu: str, text: str) -> tuple[CommandDoc, ...]:
    rows = [[field.strip() for field in line.split("|")] for line in text.strip().splitlines()]
    return tuple(CommandDoc(menu, name, f"{name} {usage}".strip(), what) for name, usage, what in rows)


COMMANDS = tuple(
    command
    for menu, text in _LISTED.items()
    for command in _read(menu, text if menu == "root" else f"{text.rstrip()}\n{_IN_EACH_SUBMENU.strip()}")
)
