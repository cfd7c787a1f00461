"""A receiver beside the dish: tuned by Doppler over Hamlib's network protocol, told when to record."""
