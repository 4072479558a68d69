"""What the first sheet says of the whole motion, against a search in Python that reads no formula."""
