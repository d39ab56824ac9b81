"""Graphs: curves, bars, how a line is drawn."""
