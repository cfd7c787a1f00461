"""What the simulated Carryout G2 and its kin share: motors, homing, settings memory, menus, knobs."""
