"""Captions of figures, filled with numbers of the results and with verdicts of the ledger."""
