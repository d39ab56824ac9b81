"""What the kernel refuses, one module a room."""
