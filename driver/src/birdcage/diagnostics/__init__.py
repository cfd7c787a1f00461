"""What of a dish needs its owner: judged from its history and its present state. Pure: it opens no port."""
