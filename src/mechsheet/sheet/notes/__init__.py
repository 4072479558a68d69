"""The sheet of notes, and equations as people write them."""
