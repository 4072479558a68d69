"""The tables: a column a quantity filled down the driver, and two-way tables."""
