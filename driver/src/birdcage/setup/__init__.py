"""From wires to the first satellite: the eleven steps, without a screen. Both faces drive them."""
