"""The Python side of the reproduction: a package for each stage, in the order of the data."""
