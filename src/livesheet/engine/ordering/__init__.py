"""In which order blocks are computed, and the steps that compute them."""
