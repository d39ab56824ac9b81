"""Bodies of plastic material in statics and dynamics: Newton's method on all unknowns."""
