"""Parts that every page is made of: panes, dialogs, status rows, footer, help and palette."""
