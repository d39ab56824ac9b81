"""Cells of Gibiane in a notebook: a kernel for Jupyter, `python -m ssilang.jupyter install`."""
