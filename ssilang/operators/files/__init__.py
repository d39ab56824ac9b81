"""Operators: what is read and written."""
