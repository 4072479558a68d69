"""What was drawn, written into the description's text: everything else in it stays as it is, comments and order too."""
