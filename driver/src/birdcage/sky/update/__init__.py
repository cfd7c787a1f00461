"""Fetches elements over the network. Only when a person asks for it: nothing here runs at start or by itself."""
