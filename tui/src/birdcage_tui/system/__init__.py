"""The System page: what stands on each of its tabs."""
