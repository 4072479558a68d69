"""What callers give: numbers, names of files to write, ranges and values of cells."""
