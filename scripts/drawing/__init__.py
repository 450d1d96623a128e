"""What several figures share: the style, panels, labels."""
