"""Many plastic points: compiled passes over elements, steps that keep their factor."""
