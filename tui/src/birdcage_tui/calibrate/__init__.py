"""F8 Calibrate: how the dish really stands, from peaks on what is where it is known to be."""
