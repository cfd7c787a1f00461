"""The raw console: a sheet that slides over the lower part of any page."""
