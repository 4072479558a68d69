"""What callers give: values (numbers, cells and their ranges), and names of files to write."""
