"""Meshes of lines: shapes of curves, cuts, corners, frames, ways along them."""
