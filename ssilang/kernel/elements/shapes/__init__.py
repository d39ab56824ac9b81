"""Reference cells: shape functions, quadrature, geometry at quadrature points."""
