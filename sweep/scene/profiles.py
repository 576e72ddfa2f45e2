"""Rigid profiles in place of platens: a striker, ribs as a base, and where they touch at rest."""

import numpy as np

from kernels.geometry.profile import Profiles
from kernels.terms import contact, contact_near_joints, profile
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.striker import WithStriker
from sweep.design.network import Network
from sweep.design.profile import Profile
from sweep.scene.coordinates import BASE, Numbering
from sweep.scene.mesh import Mesh

TOUCHING = 1e-12  # m: a profile is moved up to the lattice within this distance
NO_PROFILES = Profiles(
    np.zeros(1, np.int64), np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0, np.int64),
    np.empty((0, 4)), np.empty(0, np.int64), np.empty((0, 2), np.int64), np.empty((0, 2)),
    np.empty(0), np.empty(0), np.empty(0),
)  # fmt: skip


def gripped(loading: Loading) -> str:
    """Which rows are held: `loading.platen`, or `BASE` for a lattice that is glued to its base."""
    return BASE if loading.is_shaped and loading.platen == "glued" else loading.platen


def anchor(mesh: Mesh, numbering: Numbering, case: Case) -> Ints:
    """The x of a node in the middle of the lower row of a loose lattice in statics.

    A striker that is not flat pushes sideways from the first step on, friction lags by one step,
    and without inertia the lattice would slide away under it.
    """
    struck = isinstance(case.loading, WithStriker) and case.loading.striker != "flat"
    if not (struck and case.loading.quasi_static and case.loading.platen == "contact"):
        return np.empty(0, np.int64)
    x = mesh.points[numbering.bottom, 0]
    middle = numbering.bottom[np.argmin(np.abs(x - x.mean()))]
    return np.array([2 * middle])


def with_profiles(
    touch: contact.Contact, mesh: Mesh, network: Network, numbering: Numbering, case: Case
) -> contact.Contact:
    """Contact with the profiles of the case in place of platens."""
    if not (isinstance(case.loading, WithStriker) and case.loading.is_shaped):
        return touch
    above, below = (_shapes(case.loading, network, key) for key in ("striker", "base"))
    carrier = np.repeat([numbering.high, numbering.low], [len(above), len(below)])
    return touch._replace(
        profiles=profiles_of([*above, *below], carrier, mesh, touch),
        low_away=np.inf if below else 0.0,
        high_away=np.inf if above else 0.0,
    )


def _shapes(loading: WithStriker, network: Network, key: str) -> tuple[Profile, ...]:
    """The profiles of the "striker" or the "base" (``key``), if it is not flat."""
    (left, bottom), (right, top) = network.points.min(axis=0), network.points.max(axis=0)
    return loading.profiles(key, float(left), float(right - left), float(top - bottom))


def outlines(case: Case, network: Network) -> dict[str, Floats]:
    """Outlines of strikers and bases that are not flat, as in `Result.frames`; two ribs are put end
    to end.
    """
    if not (isinstance(case.loading, WithStriker) and case.loading.is_shaped):
        return {}
    drawn = {key: _shapes(case.loading, network, key) for key in ("striker", "base")}
    return {
        f"{key}_m": np.concatenate([shape.outline() for shape in shapes])
        for key, shapes in drawn.items()
        if shapes
    }


def profiles_of(
    shapes: list[Profile], carrier: Ints, mesh: Mesh, touch: contact.Contact
) -> Profiles:
    """The data of profiles. carrier (k,): coordinate of the platen that each one replaces."""
    return Profiles(
        start=np.cumsum([0, *(len(shape.chain) for shape in shapes)]),
        vertex=np.concatenate([shape.chain for shape in shapes]),
        weight=np.concatenate([_weight(shape, mesh) for shape in shapes]),
        radius=np.array([shape.radius for shape in shapes]),
        carrier=carrier,
        box=np.array([_box(shape) for shape in shapes]),
        nodes=np.arange(len(mesh.points)),
        edges=mesh.edges,
        subtract=contact_near_joints.owners(len(mesh.points), mesh.edges),
        tributary=touch.tributary,
        node_half=0.5 * touch.node_thickness,
        edge_half=0.5 * mesh.thickness,
    )


def _box(shape: Profile) -> Floats:
    """Least and greatest x, least and greatest y of a profile, (4,) m."""
    ends = shape.chain.min(axis=0) - shape.radius, shape.chain.max(axis=0) + shape.radius
    return np.column_stack(ends).ravel()


def _weight(shape: Profile, mesh: Mesh) -> Floats:
    """Contact length of each vertex with walls between their nodes, (v,) m (`terms.profile`)."""
    length, starts = mesh.rest_length.mean(), 0.5 * mesh.thickness.mean()
    share = length**2 / (8.0 * (shape.radius + starts) * starts)
    weight = np.zeros(len(shape.chain))
    weight[list(shape.tips)] = length * min(share, 1.0)
    return weight


def standing(x: Floats, touch: contact.Contact) -> Floats:
    """Coordinates at rest from ``x`` with flat platens, with each profile moved until it touches a
    wall.
    """
    for k, carrier in enumerate(touch.profiles.carrier):
        if k == 0 or carrier != touch.profiles.carrier[k - 1]:
            towards = -1.0 if carrier == touch.high else 1.0
            while (path := profile.free_path(x, touch.profiles, carrier, towards)) > TOUCHING:
                x[carrier] += towards * path
    return x
