"""A simulated Pathway X1 (docs/reference/g2-kin.md)."""
