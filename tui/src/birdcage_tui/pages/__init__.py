"""The pages behind F1 to F10."""
