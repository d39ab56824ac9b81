"""What solves with an interface's tangents: an inverse, LU factors, their changes, iterations."""
