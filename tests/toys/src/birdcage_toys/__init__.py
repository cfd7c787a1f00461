"""Machines that are not kind to whoever drives them, each with a twin."""
