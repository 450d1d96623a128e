"""One script and one caption for each figure."""
