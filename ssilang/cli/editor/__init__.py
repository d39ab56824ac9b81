"""What an editor asks of a script: problems, help, completion, names, layout; `server` answers."""
