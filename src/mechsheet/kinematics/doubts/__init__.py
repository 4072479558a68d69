"""What a person should hear of a description that is sound: it may not be what was meant."""
