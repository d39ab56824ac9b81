"""Operators: DYNAMIC and free-field motions."""
