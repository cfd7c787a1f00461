"""How cells are drawn: canvas, glyphs, digits, themes, and the terminal itself. Knows neither dish nor sky."""
