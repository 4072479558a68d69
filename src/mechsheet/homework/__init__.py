"""Workbooks that others have made: what is right in them, where the first fault is, exercises and marks."""
