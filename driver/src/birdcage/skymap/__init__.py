"""Maps of the sky: which directions are heard in which order, what was heard there, and what that teaches."""
