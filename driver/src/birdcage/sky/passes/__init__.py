"""When which satellite comes over."""
