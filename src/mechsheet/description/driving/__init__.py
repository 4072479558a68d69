"""[driver], [[drivers]] and [rates]: what is driven, through which values, how fast and by which law."""
