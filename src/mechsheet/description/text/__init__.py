"""The text of a description: read, its lines known, what people type mended, and changed in place."""
