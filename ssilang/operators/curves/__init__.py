"""Operators on curves and signals."""
