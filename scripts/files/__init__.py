"""How all scripts read and write files."""
