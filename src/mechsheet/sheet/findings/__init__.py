"""What can be said of a motion: each finding is one object, which every layout, `check` and the library loop over."""
