"""Shells and plates, thin and thick."""
