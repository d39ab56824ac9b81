"""Operators on numbers, comparisons and the signs."""
