"""Simulated dishes: mechanics, firmware consoles, a sky that can be heard, and a wire with faults.

It meets the driver at the bytes and nowhere else: it imports `birdcage.base.clock`, `.wake` and `.geometry` only, and
`birdcage.link` finds it through the entry point `sim`.
"""
