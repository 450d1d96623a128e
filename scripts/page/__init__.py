"""The page that shows all figures, claims and their sources."""
