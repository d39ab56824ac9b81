"""Checking of scripts without running them: phrases are read with types in place of values."""
