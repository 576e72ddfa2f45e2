"""Directors: unit vectors that turn with their node.

A node has a committed frame Q (3 x 3, orthonormal, row-major in 9 numbers) and three coordinates w,
its rotation since the last commit in its own frame, as modified Rodrigues parameters (|w| = tan of
a quarter of the angle; P. Tsiotras, J. Guid. Control Dyn. 19, 1996). With v the director in the
frame of the node,

    d(w) = Q R(w) v,   R(w) v = v + a c + b e,   c = w x v,   e = w x (w x v)
    a = 4 (1 - q) / (1 + q)^2,   b = 8 / (1 + q)^2,   q = w . w

and, with the derivatives a', a'', b', b'' of a and b in q,

    dd/dw_k = Q [2 w_k (a' c + b' e) + a c_k + b e_k]
    c_k = i_k x v,   e_k = v_k w + (w . v) i_k - 2 w_k v,   e_kl = v_l i_k + v_k i_l - 2 delta_kl v

These are smooth up to a full turn: in a snap, joints of folding walls turn by more than half a turn
in one step. Where w = 0 a small rotation turns by 4 w.
"""

from kernels.compile.jit import jit, jit_exact


@jit
def _cross(a, b):
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@jit
def _dot(a, b):
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@jit
def _factors(q):
    """Return a, b, a', b', a'', b'' at q = |w|^2."""
    by = 1.0 / (1.0 + q)
    by2 = by * by
    by3, by4 = by2 * by, by2 * by2
    return (
        4.0 * (1.0 - q) * by2, 8.0 * by2, 4.0 * (q - 3.0) * by3, -16.0 * by3,
        8.0 * (5.0 - q) * by4, 48.0 * by4,
    )  # fmt: skip


@jit
def _twice_crossed(w, v):
    """Return e = w x (w x v)."""
    along, q = _dot(w, v), _dot(w, w)
    return along * w[0] - q * v[0], along * w[1] - q * v[1], along * w[2] - q * v[2]


@jit
def turned(w, v):
    """Return R(w) v."""
    a, b, _, _, _, _ = _factors(_dot(w, w))
    c, e = _cross(w, v), _twice_crossed(w, v)
    return v[0] + a * c[0] + b * e[0], v[1] + a * c[1] + b * e[1], v[2] + a * c[2] + b * e[2]


@jit
def _unit_crossed(v, k):
    """Return c_k = i_k x v."""
    if k == 0:
        return 0.0, -v[2], v[1]
    return (v[2], 0.0, -v[0]) if k == 1 else (-v[1], v[0], 0.0)


@jit
def _slope_of_twice(w, v, k):
    """Return e_k."""
    along, a, b = _dot(w, v), v[k], -2.0 * w[k]
    one = along if k == 0 else 0.0
    two = along if k == 1 else 0.0
    three = along if k == 2 else 0.0
    return (
        a * w[0] + b * v[0] + one, a * w[1] + b * v[1] + two, a * w[2] + b * v[2] + three,
    )  # fmt: skip


@jit
def placed(frame, v):
    """Return Q v; frame (9,)."""
    return (
        frame[0] * v[0] + frame[1] * v[1] + frame[2] * v[2],
        frame[3] * v[0] + frame[4] * v[1] + frame[5] * v[2],
        frame[6] * v[0] + frame[7] * v[1] + frame[8] * v[2],
    )


@jit
def _taken_back(frame, g):
    """Return Q^T g."""
    return (
        frame[0] * g[0] + frame[3] * g[1] + frame[6] * g[2],
        frame[1] * g[0] + frame[4] * g[1] + frame[7] * g[2],
        frame[2] * g[0] + frame[5] * g[1] + frame[8] * g[2],
    )


@jit
def director(frame, w, v):
    """Return d(w)."""
    return placed(frame, turned(w, v))


@jit
def slope(frame, w, v, k):
    """Return dd/dw_k."""
    a, b, a1, b1, _, _ = _factors(_dot(w, w))
    c, e, ck, ek = _cross(w, v), _twice_crossed(w, v), _unit_crossed(v, k), _slope_of_twice(w, v, k)
    c1, e1 = 2.0 * w[k] * a1, 2.0 * w[k] * b1
    return placed(
        frame,
        (
            c1 * c[0] + e1 * e[0] + a * ck[0] + b * ek[0],
            c1 * c[1] + e1 * e[1] + a * ck[1] + b * ek[1],
            c1 * c[2] + e1 * e[2] + a * ck[2] + b * ek[2],
        ),
    )


@jit
def moment(frame, w, v, g):
    """Return g . dd/dw_k for k = 0, 1, 2; g: slopes of an energy in d."""
    a, b, a1, b1, _, _ = _factors(_dot(w, w))
    h = _taken_back(frame, g)
    whole = 2.0 * (a1 * _dot(h, _cross(w, v)) + b1 * _dot(h, _twice_crossed(w, v)))
    by = _cross(v, h)  # of the components h . c_k
    return (
        whole * w[0] + a * by[0] + b * _dot(h, _slope_of_twice(w, v, 0)),
        whole * w[1] + a * by[1] + b * _dot(h, _slope_of_twice(w, v, 1)),
        whole * w[2] + a * by[2] + b * _dot(h, _slope_of_twice(w, v, 2)),
    )


@jit
def moment_slopes(frame, w, v, g):
    """Return g . d2d/dw_k dw_l for kl = 00, 01, 02, 11, 12, 22."""
    _, b, a1, b1, a2, b2 = _factors(_dot(w, w))
    h = _taken_back(frame, g)
    along, by = _dot(h, v), _cross(v, h)
    c, e = _dot(h, _cross(w, v)), _dot(h, _twice_crossed(w, v))
    same = 2.0 * (a1 * c + b1 * e) - 2.0 * b * along
    twice = 4.0 * (a2 * c + b2 * e)
    m0 = 2.0 * (a1 * by[0] + b1 * _dot(h, _slope_of_twice(w, v, 0)))
    m1 = 2.0 * (a1 * by[1] + b1 * _dot(h, _slope_of_twice(w, v, 1)))
    m2 = 2.0 * (a1 * by[2] + b1 * _dot(h, _slope_of_twice(w, v, 2)))
    return (
        twice * w[0] * w[0] + 2.0 * w[0] * m0 + same + 2.0 * b * v[0] * h[0],
        twice * w[0] * w[1] + w[0] * m1 + w[1] * m0 + b * (v[0] * h[1] + v[1] * h[0]),
        twice * w[0] * w[2] + w[0] * m2 + w[2] * m0 + b * (v[0] * h[2] + v[2] * h[0]),
        twice * w[1] * w[1] + 2.0 * w[1] * m1 + same + 2.0 * b * v[1] * h[1],
        twice * w[1] * w[2] + w[1] * m2 + w[2] * m1 + b * (v[1] * h[2] + v[2] * h[1]),
        twice * w[2] * w[2] + 2.0 * w[2] * m2 + same + 2.0 * b * v[2] * h[2],
    )


@jit_exact
def _write_columns(frame, a, b, c):
    """Set the columns of a frame (9,)."""
    for i in range(3):
        frame[3 * i], frame[3 * i + 1], frame[3 * i + 2] = a[i], b[i], c[i]


@jit_exact
def _orthonormalise(frame):
    """Remove the round-off of products: one step of Q <- Q (3 I - Q^T Q) / 2, which converges to
    the nearest rotation with the second order (Higham, Functions of Matrices, 2008, ch. 8).
    """
    q = (
        (frame[0], frame[3], frame[6]), (frame[1], frame[4], frame[7]),
        (frame[2], frame[5], frame[8]),
    )  # fmt: skip
    aa, bb, cc = (
        1.5 - 0.5 * _dot(q[0], q[0]),
        1.5 - 0.5 * _dot(q[1], q[1]),
        1.5 - 0.5 * _dot(q[2], q[2]),
    )
    ab, ac, bc = -0.5 * _dot(q[0], q[1]), -0.5 * _dot(q[0], q[2]), -0.5 * _dot(q[1], q[2])
    a, b, c = q
    for i in range(3):
        frame[3 * i] = aa * a[i] + ab * b[i] + ac * c[i]
        frame[3 * i + 1] = ab * a[i] + bb * b[i] + bc * c[i]
        frame[3 * i + 2] = ac * a[i] + bc * b[i] + cc * c[i]


@jit_exact
def rebase(frames, x):
    """Move the rotations into the frames: Q <- Q R(w), w <- 0.

    frames (n, 9). x: coordinates; node i has x[6 i] .. x[6 i + 2] as its position, then w.
    """
    for i in range(frames.shape[0]):
        frame, w = frames[i], (x[6 * i + 3], x[6 * i + 4], x[6 * i + 5])
        if w[0] == 0.0 and w[1] == 0.0 and w[2] == 0.0:
            continue
        a = placed(frame, turned(w, (1.0, 0.0, 0.0)))
        b = placed(frame, turned(w, (0.0, 1.0, 0.0)))
        c = placed(frame, turned(w, (0.0, 0.0, 1.0)))
        _write_columns(frame, a, b, c)
        _orthonormalise(frame)
        x[6 * i + 3], x[6 * i + 4], x[6 * i + 5] = 0.0, 0.0, 0.0
