"""Cases whose material has a memory, and the same cases without."""

from sweep.config.case import Case
from sweep.config.kinds.table import TABLES
from tests.support.designs.tables import material_with

SOFTENED = {"softening_r": 7.0, "softening_m": 1e5}  # assumed: see configs/reuse.toml
PARTS = {
    "loss 20 %": {"loss": 0.2},
    "loss 40 %": {"loss": 0.4},
    "softening": SOFTENED,
    "loss 40 %, softening": {"loss": 0.4, **SOFTENED},
    "7 fibres": {"bend": "fibres"},
    "7 fibres, loss 40 %": {"bend": "fibres", "loss": 0.4},
}
KEPT = ("name", "plane", "stretch", "bend")  # keys of a material that a part does not change
CURVED = {"stretch": "nonlinear", "bend": "section"}


def changed(case, part):
    """A case with the keys of ``part`` in its material. A material that relaxes has no other
    damping.
    """
    given = {key: getattr(case.material, key) for key in KEPT} | CURVED | part
    tables = {name: getattr(case, name) for name in TABLES}
    tables["material"] = material_with(**given)
    if tables["material"].relaxes:
        tables["damping"] = {}
    return Case.of(**tables)
