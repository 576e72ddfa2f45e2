"""The effective material of an infill: nine elastic constants, buckling stresses, density."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees
from typing import Any

import numpy as np

from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.load import case_of
from sweep.effective.buckling import buckling_stress
from sweep.effective.cell import frame_of, infill_of, turned
from sweep.effective.stiffness import response, sheared


@dataclass(frozen=True, repr=False)
class EffectiveMaterial:
    """An infill as an orthotropic material; all in SI. Axes 1 and 2 are the axes of its drawing, 3
    is along the walls, out of the plane.

    angle: of axis 1 from the width of the design, rad. stiffness (3, 3): Pa, of strains 11, 22 and
    the engineering shear 12 in the plane. modulus_3: along the walls, the modulus of the material
    times the share that they fill. shear_13, shear_23: of thin walls. buckling: compressive
    stresses (Pa) along 1 and 2 at which walls buckle, inf for none. relative_density: area of the
    walls / area of the period. wall_thickness, period (2,): m, of the smallest period.
    """

    name: str
    material: str
    angle: float
    stiffness: Floats
    modulus_3: float
    shear_13: float
    shear_23: float
    poisson_of_walls: float
    buckling: tuple[float, float]
    relative_density: float
    density: float
    wall_thickness: float
    period: tuple[float, float]

    @property
    def _compliance(self) -> Floats:
        return np.asarray(np.linalg.inv(self.stiffness), dtype=np.float64)

    @property
    def modulus_1(self) -> float:
        """Young's modulus along axis 1, Pa."""
        return float(1.0 / self._compliance[0, 0])

    @property
    def modulus_2(self) -> float:
        """Young's modulus along axis 2, Pa."""
        return float(1.0 / self._compliance[1, 1])

    @property
    def shear_12(self) -> float:
        """Shear modulus in the plane, Pa."""
        return float(1.0 / self._compliance[2, 2])

    @property
    def poisson_12(self) -> float:
        """Contraction along 2 over the extension along 1."""
        return float(0.0 - self._compliance[1, 0] / self._compliance[0, 0])

    @property
    def poisson_13(self) -> float:
        """Contraction along 3 over the extension along 1: nu of the walls x E1 / E3."""
        return self.poisson_of_walls * self.modulus_1 / self.modulus_3

    @property
    def poisson_23(self) -> float:
        """Contraction along 3 over the extension along 2."""
        return self.poisson_of_walls * self.modulus_2 / self.modulus_3

    def modulus_at(self, angle: float) -> float:
        """Young's modulus in the plane at an angle (rad) from the width of the design, Pa."""
        there = np.linalg.inv(turned(self.stiffness, angle - self.angle))
        return float(1.0 / there[0, 0])

    @property
    def modulus_x(self) -> float:
        """Young's modulus along the width of the design, Pa."""
        return self.modulus_at(0.0)

    @property
    def modulus_y(self) -> float:
        """Young's modulus along the height of the design, Pa."""
        return self.modulus_at(0.5 * np.pi)

    def row(self) -> dict[str, Any]:
        """All constants by columns with their units."""
        return {
            "infill": self.name,
            "material": self.material,
            "wall_thickness_m": self.wall_thickness,
            "period_1_m": self.period[0],
            "period_2_m": self.period[1],
            "angle_deg": degrees(self.angle),
            **{f"modulus_{k}_Pa": getattr(self, f"modulus_{k}") for k in ("1", "2", "3", "x", "y")},
            **{f"shear_{k}_Pa": getattr(self, f"shear_{k}") for k in ("12", "13", "23")},
            **{f"poisson_{k}": getattr(self, f"poisson_{k}") for k in ("12", "13", "23")},
            "buckling_1_Pa": self.buckling[0],
            "buckling_2_Pa": self.buckling[1],
            "relative_density": self.relative_density,
            "density_kg_per_m3": self.density,
        }

    def __repr__(self) -> str:
        moduli = f"E1 {self.modulus_1:.4g} Pa, E2 {self.modulus_2:.4g} Pa"
        return f"<EffectiveMaterial {self.name} of {self.material}: {moduli}>"


def card(case: Case | Mapping[str, Any]) -> EffectiveMaterial:
    """The effective material of the infill of a case, without its perimeters and solid layers.

    case: a `Case`, or the tables of a config, as `crumple.case` takes them. Walls are linear, with
    the modulus, Poisson's ratio, plane state and joints of the case; strains are small. Designs
    other than periodic infills of even walls raise a `MisfitError`.
    """
    case = case_of(case)
    infill = infill_of(case)
    frame, material, depth = frame_of(infill), case.material, case.lattice.depth
    stiffness, _ = response(frame)
    rigidity = material.modulus / (2.0 * (1.0 + material.poisson))
    out_of_plane = sheared(frame, rigidity)
    first, second = (buckling_stress(frame, depth, axis) for axis in (0, 1))
    return EffectiveMaterial(
        name=infill.name,
        material=material.name,
        angle=round(infill.angle % (2.0 * np.pi), 12),
        stiffness=stiffness / depth,
        modulus_3=frame.filled * material.modulus,
        shear_13=float(out_of_plane[0, 0]),
        shear_23=float(out_of_plane[1, 1]),
        poisson_of_walls=material.poisson,
        buckling=(first, second),
        relative_density=frame.filled,
        density=frame.filled * material.density,
        wall_thickness=infill.case.lattice.wall_thickness,
        period=(float(frame.period[0]), float(frame.period[1])),
    )
