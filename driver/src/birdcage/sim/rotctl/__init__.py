"""A rotator behind a server that speaks Hamlib's rotctld protocol (`docs/reference/rotctl.md`)."""
