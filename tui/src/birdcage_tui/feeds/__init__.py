"""Where a frame's data come from: the sources of sky, pursuit, signal and calibration, and what the app keeps."""
