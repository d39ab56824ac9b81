"""How steps are solved by the size of models, and the compiled passes over their points."""
