"""Waves that come to a soil: plane waves, and the forces that bring a free field in."""
