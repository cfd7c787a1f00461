"""The ways of moving and stopping a machine, by what it does with a second move and whether it tells where it is."""
