"""A simulated Carryout G2+ (docs/reference/g2-kin.md)."""
