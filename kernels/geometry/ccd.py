"""Continuous collision detection: the first share of a step at which moving points meet.

Points move on straight lines, x + s dx. In the plane a node meets a segment when cross(b - a, p -
a), a quadratic in s, vanishes. The roots are computed in closed form without cancellation; motion
along the line of the segment is a separate case. The result is infinite if nothing meets for s up
to 2.
"""

import math

from kernels.compile.jit import jit_exact

ROUND_OFF = 1e-14  # round-off of a discriminant relative to its terms
END_TOLERANCE = 1e-9  # a hit this far beyond an end counts, relative to the length of the segment
HORIZON = 2.0  # largest s of interest: later contacts may be reported as infinite


@jit_exact
def roots(c0, c1, c2):
    """Return the real roots of c0 + c1 s + c2 s^2, infinite where missing, without cancellation."""
    if c2 == 0.0:
        return (-c0 / c1, math.inf) if c1 != 0.0 else (math.inf, math.inf)
    discriminant = c1 * c1 - 4.0 * c0 * c2
    if discriminant < 0.0:
        if discriminant < -ROUND_OFF * (c1 * c1 + abs(4.0 * c0 * c2)):
            return math.inf, math.inf
        discriminant = 0.0
    q = -0.5 * (c1 + math.copysign(math.sqrt(discriminant), c1))
    return q / c2, (c0 / q if q != 0.0 else math.inf)


@jit_exact
def _keeps_sign(c0, c1, c2, l2):
    """Return whether a bound excludes roots of c0 + c1 s + c2 s^2 for s up to `HORIZON`."""
    return abs(c0) > HORIZON * (abs(c1) + HORIZON * abs(c2)) + ROUND_OFF * l2


@jit_exact
def cross_quadratic(x, dx, a, b, c):
    """Return the coefficients of cross(a - b, c - b) along the step x + s dx."""
    ux, uy = x[2 * a] - x[2 * b], x[2 * a + 1] - x[2 * b + 1]
    wx, wy = x[2 * c] - x[2 * b], x[2 * c + 1] - x[2 * b + 1]
    dux, duy = dx[2 * a] - dx[2 * b], dx[2 * a + 1] - dx[2 * b + 1]
    dwx, dwy = dx[2 * c] - dx[2 * b], dx[2 * c + 1] - dx[2 * b + 1]
    c1 = dux * wy - duy * wx + ux * dwy - uy * dwx
    return ux * wy - uy * wx, c1, dux * dwy - duy * dwx


@jit_exact
def _position_along(x, dx, s, p, a, b):
    """Return (along, l2): projection of p - a on b - a, and the squared length, at x + s dx."""
    ux = x[2 * b] - x[2 * a] + s * (dx[2 * b] - dx[2 * a])
    uy = x[2 * b + 1] - x[2 * a + 1] + s * (dx[2 * b + 1] - dx[2 * a + 1])
    wx = x[2 * p] - x[2 * a] + s * (dx[2 * p] - dx[2 * a])
    wy = x[2 * p + 1] - x[2 * a + 1] + s * (dx[2 * p + 1] - dx[2 * a + 1])
    return ux * wx + uy * wy, ux * ux + uy * uy


@jit_exact
def _is_between(x, dx, s, p, a, b):
    """Return whether node p, on the line of a-b at s, lies between its ends."""
    if not 0.0 <= s < math.inf:
        return False
    along, l2 = _position_along(x, dx, s, p, a, b)
    return -END_TOLERANCE * l2 <= along <= (1.0 + END_TOLERANCE) * l2


@jit_exact
def _collinear_contact(x, dx, p, v):
    """Return s at which p meets v if both move on one line: (p - v) + s (dp - dv) = 0."""
    wx, wy = x[2 * p] - x[2 * v], x[2 * p + 1] - x[2 * v + 1]
    dwx, dwy = dx[2 * p] - dx[2 * v], dx[2 * p + 1] - dx[2 * v + 1]
    closing = -(wx * dwx + wy * dwy)
    return (wx * wx + wy * wy) / closing if closing > 0.0 else math.inf


@jit_exact
def first_contact(x, dx, p, a, b):
    """Return the smallest s >= 0 at which node ``p`` lies on segment a-b, infinity if never."""
    c0, c1, c2 = cross_quadratic(x, dx, a, b, p)
    _, l2 = _position_along(x, dx, 0.0, p, a, b)
    if _keeps_sign(c0, c1, c2, l2):
        return math.inf
    if abs(c0) <= ROUND_OFF * l2 and abs(c1) <= ROUND_OFF * l2 and abs(c2) <= ROUND_OFF * l2:
        return min(_collinear_contact(x, dx, p, a), _collinear_contact(x, dx, p, b))
    one, two = roots(c0, c1, c2)
    first = math.inf
    if _is_between(x, dx, one, p, a, b):
        first = one
    if two < first and _is_between(x, dx, two, p, a, b):
        first = two
    return first


@jit_exact
def first_fold(x, dx, a, b, c):
    """Return the smallest s >= 0 at which arms b-a and b-c point the same way."""
    c0, c1, c2 = cross_quadratic(x, dx, a, b, c)
    _, l2 = _position_along(x, dx, 0.0, c, b, a)
    if _keeps_sign(c0, c1, c2, l2):
        return math.inf
    first = math.inf
    for s in roots(c0, c1, c2):
        if 0.0 <= s < first:
            along, _ = _position_along(x, dx, s, c, b, a)
            if along > 0.0:
                first = s
    return first


@jit_exact
def first_shrink(x, dx, a, b, share):
    """Return the smallest s >= 0 at which segment a-b is ``share`` of its present length."""
    ux, uy = x[2 * b] - x[2 * a], x[2 * b + 1] - x[2 * a + 1]
    dux, duy = dx[2 * b] - dx[2 * a], dx[2 * b + 1] - dx[2 * a + 1]
    l2 = ux * ux + uy * uy
    one, two = roots((1.0 - share * share) * l2, 2.0 * (ux * dux + uy * duy), dux * dux + duy * duy)
    first = one if one >= 0.0 else math.inf
    return two if 0.0 <= two < first else first
