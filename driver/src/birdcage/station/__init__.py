"""One thread owns the dish: requests in, immutable events and a state out."""
