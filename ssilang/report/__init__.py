"""One page of a run's results, `report.html`: read from its folder, asks for nothing elsewhere."""
