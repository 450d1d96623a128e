"""Paths of results, the programs that make them, and their digests."""
