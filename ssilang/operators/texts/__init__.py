"""Operators on words, messages and readable layouts."""
