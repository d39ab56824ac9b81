"""Operators: the session: control, options, objects, help."""
