"""What is asked of meshes: cells and nodes chosen, sizes, quality, distances."""
