"""Barrier that keeps directors from turning over, on their angle to the normal of the corner.

    E_f = K sum over the corners  A b(v / v_f) for v < v_f, else 0,    v = d . (s x z) / a

s, z: sides of the element at the corner, d: director there; a: d . (s x z) at rest; b: `barrier`;
A: area at rest of the Gauss point at the corner. v is the cosine of the angle times the ratio of
areas, if the director was normal at rest. Beyond 90 degrees the shear of an element becomes smaller
again: without a barrier a director turned over would be a second minimum, which no real wall has.
The barrier acts only on elements that are themselves folded, or squeezed to nothing.
"""

from kernels.compile.jit import jit
from kernels.laws.barrier import barrier

START = 0.34  # v_f, the cosine of 70 degrees


@jit
def _sides(a):
    """Return the corners (from, to) of the sides along s and along z at corner ``a``."""
    if a == 0:
        return 0, 1, 0, 3
    if a == 1:
        return 0, 1, 1, 2
    return (3, 2, 1, 2) if a == 2 else (3, 2, 0, 3)


@jit
def _between(q, a, b):
    """Return the vector from corner ``a`` to corner ``b``."""
    return q[6 * b] - q[6 * a], q[6 * b + 1] - q[6 * a + 1], q[6 * b + 2] - q[6 * a + 2]


@jit
def _cross(a, b):
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@jit
def _volume(q, a):
    """Return d, s, z and d . (s x z) of corner ``a``."""
    one, two, low, high = _sides(a)
    d = (q[6 * a + 3], q[6 * a + 4], q[6 * a + 5])
    s, z = _between(q, one, two), _between(q, low, high)
    n = _cross(s, z)
    return d, s, z, d[0] * n[0] + d[1] * n[1] + d[2] * n[2]


@jit
def area(q, a):
    """Return d . (s x z) of corner ``a``."""
    return _volume(q, a)[3]


@jit
def is_folded(q):
    """Return whether a director is turned over, so that the energy is infinite."""
    for a in range(4):
        if not _volume(q, a)[3] > 0.0:
            return True
    return False


@jit
def evaluate(q, rest, areas, stiffness, slope):
    """Return E_f in J of an element that is not folded; add its slopes in q to ``slope`` (24,).

    q (24,): position and director of each corner. rest, areas (4,): a and A of the corners, m^2.
    stiffness: K, J/m^2.
    """
    total = 0.0
    for a in range(4):
        d, s, z, volume = _volume(q, a)
        v = volume / rest[a]
        if v < START:
            value, first, _ = barrier(v / START)
            total += stiffness * areas[a] * value
            _add(a, stiffness * areas[a] * first / (START * rest[a]), d, s, z, slope)
    return total


@jit
def _add(a, factor, d, s, z, slope):
    """Add ``factor`` times the slopes of d . (s x z) to ``slope``."""
    one, two, low, high = _sides(a)
    by_d, by_s, by_z = _cross(s, z), _cross(z, d), _cross(d, s)
    for k in range(3):
        slope[6 * a + 3 + k] += factor * by_d[k]
        slope[6 * one + k] -= factor * by_s[k]
        slope[6 * two + k] += factor * by_s[k]
        slope[6 * low + k] -= factor * by_z[k]
        slope[6 * high + k] += factor * by_z[k]


@jit
def hessian(q, rest, areas, stiffness, row, second):
    """Add the second derivatives of E_f in q to ``second`` (24, 24). row (24,): scratch."""
    for a in range(4):
        d, s, z, volume = _volume(q, a)
        v = volume / rest[a]
        if v < START:
            _, first, curvature = barrier(v / START)
            for i in range(24):
                row[i] = 0.0
            _add(a, 1.0 / rest[a], d, s, z, row)
            factor = stiffness * areas[a] * curvature / (START * START)
            for i in range(24):
                if row[i] != 0.0:
                    for k in range(24):
                        second[i, k] += factor * row[i] * row[k]
            _add_mixed(a, stiffness * areas[a] * first / (START * rest[a]), d, s, z, second)


@jit
def _add_mixed(a, factor, d, s, z, second):
    """Add ``factor`` times the second derivatives of d . (s x z), each in two of the vectors."""
    one, two, low, high = _sides(a)
    at = 6 * a + 3
    for sign, to in ((-1.0, 6 * one), (1.0, 6 * two)):
        _add_cross(at, to, sign * factor, z, second)
    for sign, to in ((-1.0, 6 * low), (1.0, 6 * high)):
        _add_cross(at, to, -sign * factor, s, second)
    for sign_s, from_s in ((-1.0, 6 * one), (1.0, 6 * two)):
        for sign_z, to_z in ((-1.0, 6 * low), (1.0, 6 * high)):
            _add_cross(from_s, to_z, sign_s * sign_z * factor, d, second)


@jit
def _add_cross(i, j, factor, v, second):
    """Add ``factor`` times the matrix e with a . e b = a . (b x v), and its transpose."""
    entries = (
        (0, 1, v[2]), (1, 2, v[0]), (2, 0, v[1]), (1, 0, -v[2]), (2, 1, -v[0]), (0, 2, -v[1]),
    )  # fmt: skip
    for r, c, value in entries:
        second[i + r, j + c] += factor * value
        second[j + c, i + r] += factor * value
