"""What a reader sees while ./reproduce runs: one line of progress, and errors of one line."""
