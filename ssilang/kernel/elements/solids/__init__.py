"""Continuous elements: plane, axisymmetric, Fourier, three-dimensional."""
