"""Operators: pictures."""
