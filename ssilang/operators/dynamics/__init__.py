"""Operators: DYNAMIC and what stands around it."""
