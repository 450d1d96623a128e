"""What a model is: its record, its parameters and states, and the object made of it."""
