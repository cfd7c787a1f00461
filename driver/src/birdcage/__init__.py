"""Birdcage points dishes: drivers for motorised satellite dishes, and their simulator. Imports nothing itself."""
