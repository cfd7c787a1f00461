"""The Winegard Carryout of 2003, firmware HandEra HAL 1.00.065 (`docs/reference/carryout-2003.md`).

What is known of its console, as tables and functions. No strategy of motion drives it yet.
"""
