"""The words that operators are written with: `from ssilang.operators.prelude import *`.

What is declared with (`arg`, `opt`, `flag` ...), the ranges, what a call offers, the classes of the
objects that scripts hold, and what nearly each module has of Python: `np`, `replace`, the kinds of
annotations.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, KernelError, MeshError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.language.registry import (
    ANY,
    Arg,
    Choice,
    Chosen,
    Entry,
    Flag,
    Key,
    Lead,
    Like,
    Main,
    Many,
    Name,
    Opt,
    arg,
    by,
    choice,
    flag,
    group,
    key,
    lead,
    main,
    many,
    operator,
    opt,
    said,
    select,
    shared,
)
from ssilang.language.run.call import Call, Operand
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.values import (
    ListChpo,
    ListEnti,
    ListMots,
    ListObje,
    ListReel,
    Mot,
    Procedure,
    Table,
    type_of,
)
from ssilang.language.vocabulary.terms import (
    ANY_NUMBER,
    CARRIED,
    IN_ORDER,
    NOT_NEGATIVE,
    NOT_ZERO,
    POSITIVE,
    Range,
    between,
)
from ssilang.messages.message import Teller
from ssilang.operators.workspace import Workspace, workspace
