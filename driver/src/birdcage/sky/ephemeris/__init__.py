"""Sun, Moon, planets and stars: skyfield on an excerpt of DE421 that ships with birdcage. Nothing is ever fetched."""
