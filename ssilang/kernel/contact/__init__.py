"""Contact between the sides of bodies: unilateral relations from the geometry."""
