"""Few plastic points: steps whose matrices are dense."""
