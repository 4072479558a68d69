"""What proves the table: gaps measured by geometry, and probe rows between the rows."""
