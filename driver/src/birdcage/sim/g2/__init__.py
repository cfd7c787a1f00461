"""The console of the Carryout G2, firmware 02.02.48 (docs/reference/g2.md), one file a menu."""
