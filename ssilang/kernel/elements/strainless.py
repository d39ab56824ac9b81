"""Families of elements that give matrices and have no strains."""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.family import ElementFamily, StrainOperator
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone


class StrainlessFamily(ElementFamily):
    """A family without strains and stresses; its own methods make its matrices.

    Attributes
    ----------
    refusal : str
        Code of the error where strains are asked for.
    """

    refusal: str

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """None."""
        return ()

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """None."""
        return ()

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Refused."""
        raise self.no_strains()

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Refused."""
        raise self.no_strains()

    def no_strains(self) -> FieldError:
        """The error of a request for strains."""
        return FieldError(self.refusal)
