"""The eleven steps, one small file each."""
