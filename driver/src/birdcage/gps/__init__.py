"""Where the dish stands and what time it is, as receivers, the system and watches tell. Knows no sky."""
