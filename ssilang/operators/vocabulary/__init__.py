"""The words of the language joined with what the kernel knows of them; their pages."""
