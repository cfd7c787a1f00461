"""The pursuit: plans a pass before it begins, and steers the dish along it (`docs/tracking.md`)."""
