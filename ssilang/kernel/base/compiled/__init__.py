"""Compiled code: decorators, where it is kept, functions that callers reach by address."""
