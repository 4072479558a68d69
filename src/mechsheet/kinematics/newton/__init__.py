"""Groups that no dyad can be taken from: Newton's method in a fixed number of passes, each started from the row above."""
