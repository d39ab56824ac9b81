"""Plastic laws of bodies: one law a file, with stress and consistent tangent in one function."""
