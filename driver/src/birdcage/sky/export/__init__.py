"""Passes for other programs: JSON, CSV and calendars."""
