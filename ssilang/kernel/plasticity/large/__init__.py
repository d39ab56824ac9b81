"""Bodies that yield in large displacements and strains."""
