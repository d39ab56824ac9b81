"""Cells of Gibiane in a notebook: a kernel for Jupyter, `python -P -m ssilang.jupyter install`."""
