"""One command, its echo, its reply, the prompt: a pure codec under a session that owns the deadlines."""
