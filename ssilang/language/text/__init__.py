"""From text to statements and back: sources, reader, grammar, tree."""
