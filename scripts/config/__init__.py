"""The configuration: read, merged, checked against its schema."""
