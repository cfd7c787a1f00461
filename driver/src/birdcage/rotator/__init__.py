"""The seam: what any machine is that points something. Facts, values and the interface; nothing that talks."""
