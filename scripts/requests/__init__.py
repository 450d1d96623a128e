"""What the program is asked, by the configuration: groups of namelists."""
