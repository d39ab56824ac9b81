"""What words mean: data, declared once and read by evaluation, check, help and completion."""
