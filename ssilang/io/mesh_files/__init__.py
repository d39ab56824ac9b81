"""Meshes and fields in other programs' text formats."""
