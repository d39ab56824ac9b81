"""Statements run: session, evaluator, phrases, operands, calls, procedures."""
