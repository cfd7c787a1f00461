"""The go-to line: what was typed, where that leads, and whether the dish gets there."""
