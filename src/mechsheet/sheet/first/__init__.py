"""What is on the first sheet: inputs, the position shown, results, and what can be said of the mechanism."""
