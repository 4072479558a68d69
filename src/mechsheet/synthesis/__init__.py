"""Synthesis: dimensions found from a task, in closed form. One module for each kind of task; `kinds` lists them."""
