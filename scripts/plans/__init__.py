"""What a study declares, and all studies found: all that planning a run needs of them."""
