"""The satellites that are known: their elements, their groups, and what the user says about them. One SQLite file."""

from birdcage.sky.catalogue.catalogue import Added, Catalogue
from birdcage.sky.catalogue.entry import Entry
from birdcage.sky.catalogue.groups import Group, Groups
from birdcage.sky.catalogue.search import SearchIndex

__all__ = ["Added", "Catalogue", "Entry", "Group", "Groups", "SearchIndex"]
