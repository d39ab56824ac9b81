"""Material laws: elastic moduli, tables of parameters, invariants of tensors."""
