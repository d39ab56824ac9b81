"""What operators refuse and warn of, one module a family."""
