"""Bars, beams, pipes, and beams with sections of fibres."""
