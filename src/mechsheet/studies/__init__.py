"""Studies: millions of designs of one mechanism, tried by the equations that its workbook has."""
