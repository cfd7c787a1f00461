"""A simulated Pathway X2 (docs/reference/g2-kin.md)."""
