"""Bytes: serial ports, TCP, RFC 2217, the simulator, and the transcript of all that passes."""
