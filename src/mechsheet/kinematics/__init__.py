"""From the model to the ordered list of equations that solves it."""
