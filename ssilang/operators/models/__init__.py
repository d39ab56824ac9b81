"""Operators on models, materials, frames."""
