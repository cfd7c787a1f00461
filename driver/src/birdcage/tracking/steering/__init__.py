"""While it follows: which command to send next. One controller for each kind of dish."""
