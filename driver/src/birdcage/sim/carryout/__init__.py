"""The simulated Winegard Carryout of 2003 with firmware HandEra HAL 1.00.065 (docs/reference/carryout-2003.md)."""
