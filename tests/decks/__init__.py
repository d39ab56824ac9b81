"""Decks of cases/: they run, agree with the reference solutions, and fail when they should."""
