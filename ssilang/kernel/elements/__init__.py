"""Finite elements: data (catalogue, shapes, quadrature) and the quantities of a zone."""
