"""Tables made from the results of programs, one script each, and how tables are read."""
