"""What is said to the reader: errors, catalogue, hints, translations, reference."""
