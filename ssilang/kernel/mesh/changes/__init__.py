"""Meshes made of others: moved, merged, split, refined, of another degree."""
