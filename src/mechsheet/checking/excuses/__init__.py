"""How far two right answers may differ: by what the last digits of the numbers before may do to them."""
