"""What solves with the tangents of an interface: an inverse, LU factors, their changes, iterations."""
