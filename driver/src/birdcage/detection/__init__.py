"""Which machine answers at a port, asked before anything is driven: a bare Enter, a `?`, and what speaks for whom."""
