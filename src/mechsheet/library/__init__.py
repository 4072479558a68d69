"""What `import mechsheet` offers: linkages, workbooks built, recalculated, kept open, and what was understood as text."""
