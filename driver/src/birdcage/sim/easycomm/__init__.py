"""The simulated EasyComm rotators: an RP2040 base station, and the stock SatNOGS controller."""
