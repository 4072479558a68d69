"""A whole class: the sheets that students are given, and the marks of what they hand in."""
