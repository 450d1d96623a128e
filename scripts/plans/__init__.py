"""What each figure reads, shows and is called: all that planning a run needs of it."""
