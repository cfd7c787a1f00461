"""Follows one pass after the other: plans on a thread of its own, keeps the log, runs hooks, tunes the radio."""
