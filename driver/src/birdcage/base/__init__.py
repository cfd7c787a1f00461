"""The ground floor: clock, errors, geometry, paths, config and store. Imported by all, importing none of us."""
