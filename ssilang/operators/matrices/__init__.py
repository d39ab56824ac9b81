"""Operators: stiffness, mass, damping, supports, relations."""
