"""Every text in both languages, keyed by what it says."""
