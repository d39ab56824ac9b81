"""ssilang: a Gibiane interpreter for soil-structure interaction with foundation uplift."""

__version__ = "0.1.0"
