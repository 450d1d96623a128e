"""The frequency gamma of the paper and of real faults."""

PAPER, FAULTS = 0.8, (1e4, 1e12)
"""gamma of the paper's figures, and its range for real faults."""
