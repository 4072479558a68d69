"""Where the first fault is and what would mend it: changes of formulas, tried by the thousand."""
