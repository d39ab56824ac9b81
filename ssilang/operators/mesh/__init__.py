"""Operators on points and meshes."""
