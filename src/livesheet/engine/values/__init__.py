"""What the engine computes with: numbers, texts, truth values, blanks and errors, and how one becomes the other."""
