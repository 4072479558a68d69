"""The sheet of synthesis: task, results, whether they do what the task asks, every step, tables and charts."""
