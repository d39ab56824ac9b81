"""What a person at a terminal has: lines to edit, colours, pages, where a loop is."""
