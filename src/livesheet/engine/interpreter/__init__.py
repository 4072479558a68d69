"""What a formula means: any kind of value, every error in its place; the fast path is held to it."""
