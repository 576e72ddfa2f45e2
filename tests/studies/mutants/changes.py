"""The mutants: one wrong sign, factor or index each, by the file that it is in.

A snippet occurs once in its file. Names say what is wrong.
"""

from typing import NamedTuple

LAWS, TERMS, PLANAR = "kernels/laws", "kernels/terms", "kernels/planar"
SOLVE, LINEAR = "kernels/solve", "kernels/linear"
PLATES, SPACE = "kernels/plates", "kernels/geometry/space"


class Mutant(NamedTuple):
    """What is wrong, in which file of the repository, and how: ``snippet`` becomes ``wrong``.

    tests: a file of tests, or one of them, that run first.
    """

    name: str
    path: str
    snippet: str
    wrong: str
    tests: str


def _of(path, *changes, tests=None):
    """Mutants of one file; ``tests``, by default its mirror."""
    folder, _, name = path.rpartition("/")
    first = f"tests/{tests or f'{folder}/test_{name}'}"
    return [Mutant(*change[:1], path, *change[1:], first) for change in changes]


MUTANTS = [
    *_of(
        f"{TERMS}/stretch.py",
        ("stretch: energy", "total += volume * density", "total -= volume * density"),
        ("stretch: length of the arc", "return along + arc", "return along - arc"),
        ("stretch: gradient", "volume * stress * one\n", "-volume * stress * one\n"),
        ("stretch: Hessian along", "tangent * by_l0 * by_l0", "-tangent * by_l0 * by_l0"),
        (
            "stretch: Hessian of the arc",
            "tangent * one * two + mixed",
            "tangent * one * two - mixed",
        ),
        ("stretch: projection left out", "if projected:", "if False:"),
    ),
    *_of(
        f"{LAWS}/elastic.py",
        ("elastic law: tangent", "c[1] + s * (2.0 * c[2]", "c[1] - s * (2.0 * c[2]"),
        ("elastic law: stress beyond", "stress + beyond * tangent", "stress - beyond * tangent"),
        ("elastic law: stress of the guard", "stress + slope, tangent", "stress - slope, tangent"),
    ),
    *_of(
        f"{LAWS}/elastic.py",
        (
            "fibres: with the barrier",
            "return curve(law, strain)",
            "return respond(law, strain)",
        ),
        tests=f"{TERMS}/test_section.py",
    ),
    *_of(
        f"{LAWS}/relaxation.py",
        ("relaxation: stress", "scale * stress + slope, scale", "scale * stress - slope, scale"),
        ("relaxation: tangent", "+ slope, scale * tangent", "+ slope, tangent"),
        ("relaxation: past", "decay[i] * x - pace.gain", "decay[i] * x + pace.gain"),
        ("relaxation: dissipation", "+ weights[1] * x * change", "- weights[1] * x * change"),
        ("relaxation: stored energy", "kept - energy)\n    state[", "kept + energy)\n    state["),
        ("relaxation: branch", "* x + pace.gain[i] * change", "* x - pace.gain[i] * change"),
        ("relaxation: complement", "+ 0.5 * move * gap", "- 0.5 * gap"),
    ),
    *_of(
        f"{TERMS}/section.py",
        ("section: thinning of a fibre", "0.5 * (1.0 - m), (1.0", "-0.5 * (1.0 - m), (1.0"),
        ("section: other side", "weight * second, place * a_t", "weight * second, a_t"),
        ("section: radial stress", "tt = 0.0, 0.0, -law.radial", "tt = 0.0, 0.0, law.radial"),
        ("section: centre line", "w1 + w2 - law.middle * value", "w1 + w2 + law.middle * value"),
    ),
    *_of(
        f"{TERMS}/elements.py",
        ("element: moment across the chord", "* ty + moment * tx", "* ty - moment * tx"),
        ("element: moment on the node", "slope[2, k] -= force[1", "slope[2, k] += force[1"),
        ("element: curve of the bearing", "- curls * moment", "+ curls * moment"),
        ("element: chord and rotation", "lean[3, k] -= b2", "lean[3, k] += b2"),
        ("element: product", "m2 = lean[2, k] * ex", "m2 = -lean[2, k] * ex"),
    ),
    *_of(
        f"{TERMS}/bend.py",
        ("bend: energy", "first * one + second * two", "first * one - second * two"),
        ("bend: moment", "force[1, k] += first", "force[1, k] -= first"),
        (
            "bend: rigidity between the ends",
            "first * s1, k12 * d1 * d2",
            "first * s1, -k12 * d1 * d2",
        ),
        ("bend: bent measure", "d1 * d1 + first * s1", "d1 * d1 - first * s1"),
    ),
    *_of(
        f"{TERMS}/bend.py",
        ("bend: moment of the section", "e1 + m1 * p - m2 * q", "e1 + m1 * p + m2 * q"),
        ("bend: rigidity of the section", "(tt1 + tt2) * p * q", "(tt1 - tt2) * p * q"),
        ("bend: force of the section", "+= by_length * by_e", "-= by_length * by_e"),
        (
            "bend: shear",
            "+= rigid + volume * (\n        (ee * e1",
            "+= volume * (\n        (ee * e1",
        ),
        tests=f"{TERMS}/test_section.py",
    ),
    *_of(
        f"{TERMS}/fold.py",
        (
            "fold: energy",
            "total += fold.stiffness[k] * value",
            "total -= fold.stiffness[k] * value",
        ),
        ("fold: gradient", "moment = fold.stiffness", "moment = -fold.stiffness"),
        ("fold: Hessian between arms", "a, c, -rigidity", "a, c, rigidity"),
        ("fold: curvature of the angle", "b, a, -scale * slope", "b, a, scale * slope"),
    ),
    *_of(
        f"{TERMS}/spring.py",
        ("spring: energy", "total += 0.5 *", "total -= 0.5 *"),
        (
            "spring: gradient",
            "b, a, spring.stiffness[k] * stretched",
            "b, a, -spring.stiffness[k] * stretched",
        ),
        ("spring: Hessian", "spring.stiffness[k], force", "spring.stiffness[k], -force"),
    ),
    *_of(
        f"{TERMS}/inertia.py",
        ("inertia: energy", "total += force", "total -= force"),
        ("inertia: gradient", "g[i] += force", "g[i] -= force"),
        ("inertia: Hessian", "diagonal[i] += factor", "diagonal[i] -= factor"),
    ),
    *_of(
        f"{TERMS}/loads.py",
        ("loads: energy", "return -factor", "return factor"),
        ("loads: gradient", "g[i] -= factor", "g[i] += factor"),
    ),
    *_of(
        f"{TERMS}/damping.py",
        ("damping by mass: energy", "total += 0.5 * alpha", "total -= 0.5 * alpha"),
        ("damping by mass: gradient", "g[i] += alpha", "g[i] -= alpha"),
        ("damping by mass: Hessian", "diagonal[i] += factor", "diagonal[i] -= factor"),
    ),
    *_of(
        f"{TERMS}/rayleigh.py",
        ("Rayleigh: energy", "return 0.5 * rate", "return -0.5 * rate"),
        ("Rayleigh: gradient", "before, u, rate, shape", "before, u, -rate, shape"),
        ("Rayleigh: Hessian", "before, rate)", "before, -rate)"),
        tests=f"{TERMS}/test_damping.py",
    ),
    *_of(
        f"{TERMS}/kelvin_voigt.py",
        ("Kelvin-Voigt: energy", "total += 0.5 * volume", "total -= 0.5 * volume"),
        ("Kelvin-Voigt: gradient", "stress = viscosity", "stress = -viscosity"),
        ("Kelvin-Voigt: Hessian", "stress, viscosity, projected", "stress, -viscosity, projected"),
        ("Kelvin-Voigt: moments", "k11 * one + k12 * two", "k11 * one - k12 * two"),
        ("Kelvin-Voigt: rate ahead", "bearing - v[dofs[k, 5]]", "bearing + v[dofs[k, 5]]"),
        tests=f"{TERMS}/test_damping.py",
    ),
    *_of(
        f"{LAWS}/barrier.py",
        ("barrier: energy", "value = -r * r", "value = r * r"),
        ("barrier: slope", "slope = -r *", "slope = r *"),
        ("barrier: curvature", "+ r * r / (s * s)", "- r * r / (s * s)"),
        ("contact: curvature of phi", "scale / starts *", "scale * starts *"),
    ),
    *_of(
        f"{TERMS}/contact.py",
        (
            "contact: energy",
            "        total += value\n        if end < 0",
            "        total -= value\n        if end < 0",
        ),
        ("contact: gradient", "push(g, x, p, a, b, slope)", "push(g, x, p, a, b, -slope)"),
        ("contact: Hessian", "0.0 if projected else slope)", "0.0 if projected else -slope)"),
        ("contact: vertices count twice", "end, -0.5 * length", "end, 0.5 * length"),
        (
            "contact: normal force",
            "touching.distance[n])\n    return -slope",
            "touching.distance[n])\n    return slope",
        ),
        ("platens: energy", "                total += value", "                total -= value"),
        ("platens: force on the platen", "g[platen] -= side * slope", "g[platen] += side * slope"),
        ("platens: Hessian", "2 * p + 1, -curvature", "2 * p + 1, curvature"),
        ("platens: step limit", "closing > 0.0", "closing < 0.0"),
    ),
    *_of(
        f"{TERMS}/contact_near_joints.py",
        (
            "near joints: corners of no account",
            "math.tan(half) - half",
            "math.tan(half) - math.tan(half)",
        ),
        ("near joints: angle of no account", "math.hypot(path, t)", "path"),
        ("near joints: walls stressed at rest", "REST_SHARE = 0.9", "REST_SHARE = 1.1"),
        ("near joints: corners pressed", "GUARDED_SHARE = 0.2", "GUARDED_SHARE = 0.9"),
        (
            "near joints: vertices not taken off",
            "weight[k] > weight[e] or",
            "weight[k] < weight[e] or",
        ),
    ),
    *_of(
        f"{TERMS}/friction.py",
        ("friction: energy", "(value - eps / 3.0)", "(eps / 3.0 - value)"),
        ("friction: gradient", "g[i] += lagged_", "g[i] -= lagged_"),
        ("friction: Hessian", "return (1.0 - w * slope) / psi", "return (1.0 + w * slope) / psi"),
        ("friction: turning walls slip", "-d * uy / length", "d * uy / length"),
        ("friction: duals", "+ curvature(before", "- curvature(before"),
    ),
    *_of(
        f"{PLANAR}/position_based.py",
        ("by position: pulled", "(d_contact - d) / weight", "(d - d_contact) / weight"),
        (
            "by position: off a platen",
            "x[platen] + side * d_contact",
            "x[platen] - side * d_contact",
        ),
    ),
    *_of(
        f"{PLANAR}/couplings.py",
        ("couplings: too late", "1.0 + MARGIN", "1.0 - MARGIN"),
        ("couplings: no springs", "n = _couple(nodes, n, a, a, b)", "pass"),
    ),
    *_of(
        f"{LINEAR}/condensed/block_ldlt.py",
        ("factor: second pivot", "values[at + 5] -= l10", "values[at + 5] += l10"),
        ("factor: third pivot never negative", "not (c > 0.0 or", "not (c != 0.0 or"),
    ),
    *_of(
        f"{LINEAR}/condensed/condense.py",
        ("walls: elimination", "spread(-1.0) * load", "spread(1.0) * load"),
        ("walls: no negative pivot", "not (pivot > 0.0 or", "not (pivot != 0.0 or"),
    ),
    *_of(
        f"{SOLVE}/newton.py",
        ("line search: slope", "share * (slope +", "share * (-slope +"),
        ("Newton: direction", "-found.g[i] - direction[i]", "found.g[i] - direction[i]"),
        (
            "Newton: saddles accepted",
            "if descent.stable and descent.balanced:",
            "if descent.balanced:",
        ),
    ),
    *_of(
        f"{SOLVE}/march.py",
        (
            "friction: lagged again where it is not needed",
            "progress.corrections == corrections or",
            "progress.corrections == 1 - corrections or",
        ),
        tests=f"{SOLVE}/test_chain.py",
    ),
    *_of(
        f"{SOLVE}/energy_book.py",
        ("book: dissipation by friction", "book.friction += friction", "book.friction -= friction"),
        ("book: loss of the integrator", "book.integrator += loss", "book.integrator -= loss"),
        tests=f"{SOLVE}/test_one_degree_of_freedom.py",
    ),
    *_of(
        f"{SOLVE}/integrators.py",
        ("bdf2: length", "(last + 2.0 * dt)", "(last + 1.5 * dt)"),
        ("newmark: acceleration", "after - before - ahead", "after - before + ahead"),
        ("prediction: place", "+ ahead * rates.position[i]", "- ahead * rates.position[i]"),
        tests=f"{SOLVE}/test_one_degree_of_freedom.py",
    ),
    *_of(
        f"{SOLVE}/arc_length.py",
        ("arc: constraint", "increment = -(0.5 * gap +", "increment = (0.5 * gap +"),
        (
            "arc: back along the path",
            "(tangent, last_move, arc.weight) < 0.0 else 1.0",
            "(tangent, last_move, arc.weight) > 0.0 else 1.0",
        ),
        tests=f"{SOLVE}/test_chain.py::test_an_arc_follows_the_slope_of_the_well",
    ),
    *_of(
        f"{SPACE}/derivatives.py",
        ("space: across the closest points", "factor * part * q[i]", "-factor * part * q[i]"),
        (
            "space: turning normal",
            "(0.0, -force, -force * d))\n        _add(K, q, sigma",
            "(0.0, force, -force * d))\n        _add(K, q, sigma",
        ),
        ("space: projection", "scale = -force * eigenvalue", "scale = force * eigenvalue"),
    ),
    *_of(
        f"{SPACE}/parallel.py",
        ("parallel edges: second derivative", "- inner(u, v) * same", "+ inner(u, v) * same"),
    ),
    *_of(
        f"{SPACE}/advancement.py",
        (
            "advancement: whole distance",
            "share = (1.0 - KEPT) * distance / speed\n    return s",
            "share = 3.0 * distance / speed\n    return s",
        ),
    ),
    *_of(
        f"{LAWS}/log_strain.py",
        ("logarithm: deviator", "mean - half * u", "mean + half * u"),
        ("logarithm: slope by the mean", "half * wp - by * d", "half * wp + by * d"),
        ("logarithm: mixed", "2.0 * rise * (u * in_v + v * in_u)", "2.0 * rise * (u * in_v)"),
        ("logarithm: sum of powers", "second * y + 2.0 * first", "second * y + first"),
    ),
    *_of(
        f"{LAWS}/relaxing_sheet.py",
        ("relaxing sheet: stress", "decay * (s[k] - state[at + k])", "decay * s[k]"),
        ("relaxing sheet: constant", "* state[ENERGY] - past", "* state[ENERGY] + past"),
        ("relaxing sheet: viscous strain", "(d2 + d3) * r1 - d3 * r2", "(d2 + d3) * r1 + d3 * r2"),
        ("relaxing sheet: dissipation", "weights[2] * _inner(change", "weights[1] * _inner(change"),
        ("relaxing sheet: stored", "complement - _inner(own", "complement + _inner(own"),
    ),
    *_of(
        f"{PLATES}/element/relaxing_shear.py",
        ("relaxing shear: rest", "rest[k] - slope[k] / scale", "rest[k] + slope[k] / scale"),
        ("relaxing shear: constant", "state[STORED] - scale", "state[STORED] + scale"),
        ("relaxing shear: dissipation", "work = 2.0 * weights[0]", "work = weights[0]"),
    ),
    *_of(
        f"{PLATES}/steps.py",
        (
            "memory along: stored",
            "found.stored[BEND] -= released",
            "found.stored[BEND] += released",
        ),
        tests="physics/test_memory_along.py",
    ),
    *_of(
        f"{PLATES}/contacts/pairs.py",
        (
            "surfaces: corners",
            "weight[contact.edges[listed[j] - n_nodes, i]] -= weight",
            "weight[contact.edges[listed[j] - n_nodes, i]] += weight",
        ),
        tests=f"{PLATES}/contacts/test_contact.py::test_parallel_sheets_count_once_at_any_mesh",
    ),
    *_of(
        f"{PLATES}/contacts/contact.py",
        ("surfaces: edges that turn", "0] + k] -= value * first", "0] + k] += value * first"),
        tests=f"{PLATES}/contacts/test_contact.py::test_derivatives_of_parallel_edges",
    ),
    *_of(
        f"{PLATES}/contacts/contact.py",
        ("surfaces: platen", "g[platen] -= side * slope", "g[platen] += side * slope"),
        tests=f"{PLATES}/contacts/test_contact.py::test_derivatives_against_platens",
    ),
    *_of(
        f"{PLATES}/contacts/touching.py",
        ("surfaces: half of a side", "touching, p, e, s, k)", "touching, p, e, 1.0 - s, k)"),
        tests=f"{PLATES}/contacts/test_contact.py::test_derivatives_above_corners_sides_and_the_rim",
    ),
    *_of(
        f"{PLATES}/contacts/friction.py",
        ("friction in space: rotation", "_turn(slopes, 1, d, u", "_turn(slopes, 1, -d, u"),
        ("friction in space: mixed", "-0.5 * slope * (one * f", "0.5 * slope * (one * f"),
        ("friction in space: dual", "+ c12 * move[1]", "- c12 * move[1]"),
    ),
    *_of(
        f"{PLATES}/element/shell.py",
        ("shell: force along s", "r[0] * xs + r[1] * ds", "r[0] * xs - r[1] * ds"),
        ("shell: strain at rest", "measure[k] -= shell.rest", "measure[k] += shell.rest"),
    ),
    *_of(
        f"{PLATES}/element/layers.py",
        ("layers: thickening", "cube = -0.5 * j * j * j", "cube = 0.5 * j * j * j"),
        ("layers: Hessian", "second[2, 2] += 2.0 * curl", "second[2, 2] -= 2.0 * curl"),
    ),
    *_of(
        f"{PLATES}/element/shear.py",
        (
            "shear of plates: strained surface",
            "1.0 / det, p * a[1] + q * a[0] - 2.0 * r",
            "1.0 / det, p * a[1] + q * a[0] + 2.0 * r",
        ),
        ("shear of plates: long quads", "1.0 + share * size[0]", "1.0 - share * size[0]"),
    ),
    *_of(
        f"{PLATES}/element/fold.py",
        (
            "fold of a shell: gradient",
            "by_s, by_z = _cross(s, z), _cross(z, d)",
            "by_s, by_z = _cross(s, z), _cross(d, z)",
        ),
        ("fold: Hessian", "(at, to, -sign * factor, s", "(at, to, sign * factor, s"),
    ),
    *_of(
        f"{PLATES}/element/bow.py",
        ("arc of plates: bending", "m[3 + k] += q * b", "m[3 + k] -= q * b"),
        ("arc of plates: at rest", "m[k] += q - q0", "m[k] += q + q0"),
    ),
    *_of(
        f"{PLATES}/element/rotation.py",
        ("rotation: moment", "by = _cross(v, h)  # of", "by = _cross(h, v)  # of"),
        ("rotation: second derivative", "w[0] * m1 + w[1] * m0 + b", "w[0] * m1 + w[1] * m0 - b"),
    ),
    *_of(
        f"{PLATES}/contacts/mirror.py",
        ("mirror: force", "coordinate[i]] -= slope", "coordinate[i]] += slope"),
    ),
    *_of(
        f"{LAWS}/sheet.py",
        ("sheet: shear", "q * v + g * j3)", "q * v - g * j3)"),
        ("sheet: Hessian", "vv + gg * j3 * j3 - 2.0 * g", "vv + gg * j3 * j3 + 2.0 * g"),
    ),
]
