"""The satellites that are known: their elements, their groups, and what the user says about them. One SQLite file."""

from birdcage.sky.catalogue.catalogue import AddedElements, Catalogue
from birdcage.sky.catalogue.entry import CatalogueEntry
from birdcage.sky.catalogue.groups import CatalogueGroup, CatalogueGroups
from birdcage.sky.catalogue.search import SearchIndex

__all__ = ["AddedElements", "Catalogue", "CatalogueEntry", "CatalogueGroup", "CatalogueGroups", "SearchIndex"]
