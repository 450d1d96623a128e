"""One script and one template of a caption for each figure."""
