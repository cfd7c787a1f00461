"""Following a target: what the Craft tab, the dashboard and the pocket view show of it."""
