"""What goes over the coax of an LNB besides the signal: messages of the DiSEqC bus, in bytes and in words."""
