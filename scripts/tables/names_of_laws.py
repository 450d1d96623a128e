"""Names of the laws of event sizes."""

CUT_OFF = "truncated_power_law"
RIVALS = ("exponential", "lognormal", CUT_OFF)
"""Laws that a power law is compared with: the last is one with an exponential cut-off."""
