"""Mass taken off contact nodes (Khenous, Laborde and Renard 2008), by static condensation."""

import numpy as np

from ssilang.kernel.base.errors import SingularMatrixError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.inverse import invert


def without_contact_mass(M: sp.csr_array, K: sp.csr_array, G: sp.csr_array) -> sp.csr_array:
    """The mass taken off the unknowns of contact rows and given to their neighbours.

    The unknowns that G (m, n) touches follow the others by statics, `u_c = -K_cc^-1 K_cn u_n`;
    rigid motions, and with them total mass, centre and inertia, are kept.

    Raises
    ------
    SingularMatrixError
        If no stiffness ties the contact unknowns to others.
    """
    n = K.shape[0]
    touched = np.zeros(n, bool)
    touched[np.unique(G.indices)] = True
    stiff = K.diagonal() > 0.0
    c, rest = np.flatnonzero(touched & stiff), np.flatnonzero(~(touched & stiff))
    inverse = invert(sp.csr_array(K[c][:, c]), True)
    if inverse.singular:
        raise SingularMatrixError("kernel.contact.mass-contact-nodes-cannot")
    follow = -inverse.solve(K[c][:, rest].toarray())
    P = sp.lil_array((n, n))
    P[rest, rest] = 1.0
    row, column = np.nonzero(follow)
    placed = (follow[row, column], (c[row], rest[column]))
    full = sp.csr_array(P) + sp.csr_array(placed, shape=(n, n))
    return sp.csr_array(full.T @ M @ full)
