"""The parts of the page of passes: values, words, panes."""
