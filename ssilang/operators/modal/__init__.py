"""Operators: modes and modal bases."""
