"""Operators: loads, statics, stresses, PASAPAS."""
