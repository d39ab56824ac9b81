"""The words that operators are written with: `from ssilang.operators.prelude import *`.

What is declared with (`arg`, `opt`, `flag` ...), the ranges, what a call offers, the classes of the
objects that scripts hold, and what nearly each module has of Python: `np`, `replace`, the kinds of
annotations.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial, reduce
from typing import TYPE_CHECKING, Any, NoReturn, cast

import numpy as np
from numpy.typing import NDArray

from ssilang.io.errors import InputError
from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import (
    FieldError,
    KernelError,
    MaterialError,
    MeshError,
    NoResultError,
)
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, dual_of
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.language.filled import Filled
from ssilang.language.registry import (
    ANY,
    Arg,
    Argument,
    Cases,
    Choice,
    Chosen,
    Each,
    Entry,
    Flag,
    Key,
    Lead,
    Like,
    Main,
    Many,
    Name,
    OneOf,
    Opt,
    When,
    arg,
    by,
    choice,
    each,
    either,
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
from ssilang.language.text.source import Span
from ssilang.language.values import (
    ANNULE,
    Annule,
    LazyRows,
    LazyTable,
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
    BELOW_CRITICAL,
    CARRIED,
    IN_ORDER,
    NOT_NEGATIVE,
    NOT_ZERO,
    POSITIVE,
    RISING,
    Range,
    between,
)
from ssilang.language.vocabulary.unit_systems import SYSTEMS, UnitSystem
from ssilang.messages.message import Sentence, Teller
from ssilang.operators.workspace import Workspace, workspace
