"""Meshes made between or along others: sweeps, stitches, joints."""
