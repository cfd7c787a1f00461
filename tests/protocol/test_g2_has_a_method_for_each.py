"""Each command of the inventory that does no harm has a typed method: all are called, and their lines are noted."""

from __future__ import annotations

from birdcage.console.session import Console
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.rotator.verdict import Grade

CALLS = (
    lambda g: (g.get_position(), g.identity(), g.read_speeds(), g.settings_table(), g.nvs.read(20)),
    lambda g: (g.drivers.current_mode(), g.drivers.faults(), g.drivers.step_mode()),
    lambda g: (g.drivers.step_size_sixteenths(), g.drivers.torque(), g.drivers.clear_faults()),
    lambda g: (g.adc.board_id(), g.adc.board_revision(), g.adc.rssi_counts(), g.adc.monitor(1)),
    lambda g: (g.dipswitch.read(), g.eeprom.read(0), g.latlon.triangulate(199, 43, 214, 37)),
    lambda g: (g.gpio.direction("B0"), g.gpio.read("B0"), g.gpio.registers()),
    lambda g: (g.peak.rssi(), g.peak.switch_status()),
    lambda g: (g.motors.list(), g.motors.steps(), g.motors.velocities(), g.motors.max_velocities()),
    lambda g: (g.motors.max_accelerations(), g.motors.gains(), g.motors.life(), g.motors.life_details()),
    lambda g: (g.motors.elevation_limits(), g.motors.elevation_to_steps(45), g.motors.steps_to_elevation(3120)),
    lambda g: (g.stepper.max_speeds_deg_s(), g.stepper.max_accelerations(), g.stepper.gains()),
    lambda g: (g.tuner.agc(), g.tuner.snr_db(), g.tuner.network_id(), g.tuner.lnb_volts(), g.tuner.rssi()),
    lambda g: (g.tuner.identity(), g.tuner.channel(), g.tuner.lock_status(), g.tuner.quick_lock_status()),
    lambda g: (g.tuner.statistics(), g.tuner.diagnostics(), g.tuner.frequencies()),
    lambda g: (g.tuner.diseqc.address(), g.tuner.diseqc.pre_transmit_ms(), g.tuner.diseqc.reply_timeout_ms()),
    lambda g: (g.tuner.diseqc.tone_threshold_counts(), g.tuner.diseqc.lnb_config(), g.tuner.diseqc.lnb_identity()),
    lambda g: (g.tuner.diseqc.lnb_status(), g.tuner.diseqc.switch_status()),
)
NEEDS_AN_ARGUMENT = {
    "ee": "ee 0",
    "dir": "dir B0",
    "r": "r B0",
    "l": "l 1 2 3 4",
    "rssi": "rssi 10",
    "ela2s": "ela2s 45",
    "els2a": "els2a 900",
}
NOT_A_QUESTION = {"?", "help", "man", "q"}
ANSWERED_OTHERWISE = {("nvs", "e")}
"""`d <index>` tells more than `e <index>`."""


def test_each_harmless_command_is_sent_by_some_method(simulated, monkeypatch):
    g2 = simulated("seed=1&az=-158&el=42")
    sent = set()
    run, stream = Console.run, Console.stream

    def note_run(console, menu, command, **how):
        sent.add((menu, command.split()[0]))
        return run(console, menu, command, **how)

    def note_stream(console, command, *how):
        sent.add((console.place, command))
        return stream(console, command, *how)

    monkeypatch.setattr(Console, "run", note_run)
    monkeypatch.setattr(Console, "stream", note_stream)
    for call in CALLS:
        call(g2)
    harmless = {
        (command.menu, command.name)
        for command in CarryoutG2Protocol.commands
        if command.menu != "root" and command.name not in NOT_A_QUESTION
        and Grade.HARMLESS in {
            g2.judge(line, command.menu, homed=True).grade
            for line in (command.name, NEEDS_AN_ARGUMENT.get(command.name, command.name))
        }
    }  # fmt: skip
    assert len(harmless) > 50
    assert harmless - sent == ANSWERED_OTHERWISE
