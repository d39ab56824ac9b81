"""Operators: the motion of the ground that comes in, and edges that let it out."""
