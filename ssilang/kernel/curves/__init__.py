"""Curves, their algebra, and clouds of named values."""
