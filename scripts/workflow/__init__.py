"""What the workflow asks before and between its rules: packages, folders, imports, the commit."""
