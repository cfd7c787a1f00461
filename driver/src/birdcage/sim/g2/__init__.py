"""The console of the Carryout G2, firmware 02.02.48 (reference section 7), one file a menu."""
