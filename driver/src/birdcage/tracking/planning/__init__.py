"""Before the dish moves: what of a pass it will follow, along which course, and how well."""
