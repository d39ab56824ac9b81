"""Bodies that yield in large strains."""
