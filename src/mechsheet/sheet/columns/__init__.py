"""Which columns the tables have: the equations as cells compute them, and what is found beside them."""
