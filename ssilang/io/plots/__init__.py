"""Pictures of curves, meshes and fields, drawn off screen with matplotlib.

matplotlib is imported when the first picture is drawn, not before.
"""
