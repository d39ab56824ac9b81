"""Meshes of surfaces: grids, triangulations, cuts and crossings."""
