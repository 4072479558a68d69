"""The array code of every function, a module for each subject; `table` finds the one that a formula needs."""
