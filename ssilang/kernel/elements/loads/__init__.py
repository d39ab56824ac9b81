"""Nodal forces of pressures, tractions, body forces and changes of temperature."""
