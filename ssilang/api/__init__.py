"""Scripts from Python: run, check, sweep; results as numbers, arrays, frames, grids, pictures.

`import ssilang` has what stands here by name (`ssilang.run` ...), imported when first used.
"""
