"""Operators on lists."""
