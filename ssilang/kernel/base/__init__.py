"""What all of the kernel stands on: types, errors, memory, sparse; it imports nothing of ours."""
