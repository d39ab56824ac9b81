"""Meshes of volumes: bricks and tetrahedra inside closed surfaces."""
