"""How the dish really stands: a pointing model fitted from peaks on what is where it is known to be."""
