"""The dyads, a module for each kind: the equations of two links that are joined to each other and to what is known."""
