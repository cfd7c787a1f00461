"""What any machine is to those above: an interface, facts and values (SEAMS *Rotator*). Languages implement it."""
