"""Operators on nodal and element fields."""
