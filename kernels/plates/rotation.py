"""Directors: unit vectors that turn with their node.

A node has a committed frame Q (3 x 3, orthonormal, row-major in 9 numbers) and three coordinates w,
its rotation since then in its own frame, as a Rodrigues vector (|w| = tan of half the angle):

    d(w) = Q R(w) v,   R(w) v = v + s u,   s = 2 / (1 + w.w),   u = w x v + w x (w x v)

with v the director in the frame of the node. The derivatives in w_k follow from

    ds/dw_k = -s^2 w_k                       d2s/dw_k dw_l = 2 s^3 w_k w_l - s^2 delta_kl
    du/dw_k = e_k x v + (w.v) e_k + v_k w - 2 w_k v
    d2u/dw_k dw_l = v_l e_k + v_k e_l - 2 delta_kl v

A rotation by 180 degrees is at infinity, so that steps must be shorter (J. Argyris, An excursion
into large rotations, 1982, on such vectors).
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
def _bend(w, v):
    """Return s and u."""
    along, square = _dot(w, v), _dot(w, w)
    c = _cross(w, v)
    return 2.0 / (1.0 + square), (
        c[0] + along * w[0] - square * v[0],
        c[1] + along * w[1] - square * v[1],
        c[2] + along * w[2] - square * v[2],
    )


@jit
def turned(w, v):
    """Return R(w) v."""
    s, u = _bend(w, v)
    return v[0] + s * u[0], v[1] + s * u[1], v[2] + s * u[2]


@jit
def _slope_of_bend(w, v, k):
    """Return du/dw_k."""
    along, a, b = _dot(w, v), v[k], -2.0 * w[k]
    if k == 0:
        c = (along, -v[2], v[1])
    elif k == 1:
        c = (v[2], along, -v[0])
    else:
        c = (-v[1], v[0], along)
    return c[0] + a * w[0] + b * v[0], c[1] + a * w[1] + b * v[1], c[2] + a * w[2] + b * v[2]


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
    s, u = _bend(w, v)
    du, ds = _slope_of_bend(w, v, k), -s * s * w[k]
    return placed(frame, (ds * u[0] + s * du[0], ds * u[1] + s * du[1], ds * u[2] + s * du[2]))


@jit
def moment(frame, w, v, g):
    """Return g . dd/dw_k for k = 0, 1, 2: an energy with the slope g in d has this slope in w."""
    s, u = _bend(w, v)
    h = _taken_back(frame, g)
    whole = -s * s * _dot(h, u)
    return (
        whole * w[0] + s * _dot(h, _slope_of_bend(w, v, 0)),
        whole * w[1] + s * _dot(h, _slope_of_bend(w, v, 1)),
        whole * w[2] + s * _dot(h, _slope_of_bend(w, v, 2)),
    )


@jit
def moment_slopes(frame, w, v, g):
    """Return g . d2d/dw_k dw_l for kl = 00, 01, 02, 11, 12, 22."""
    s, u = _bend(w, v)
    h = _taken_back(frame, g)
    a, s2 = _dot(h, u), s * s
    b0 = _dot(h, _slope_of_bend(w, v, 0)) * s2
    b1 = _dot(h, _slope_of_bend(w, v, 1)) * s2
    b2 = _dot(h, _slope_of_bend(w, v, 2)) * s2
    twice, same = 2.0 * s * s2 * a, -s2 * a - 2.0 * s * _dot(h, v)
    return (
        twice * w[0] * w[0] + same - 2.0 * w[0] * b0 + 2.0 * s * h[0] * v[0],
        twice * w[0] * w[1] - w[0] * b1 - w[1] * b0 + s * (h[0] * v[1] + h[1] * v[0]),
        twice * w[0] * w[2] - w[0] * b2 - w[2] * b0 + s * (h[0] * v[2] + h[2] * v[0]),
        twice * w[1] * w[1] + same - 2.0 * w[1] * b1 + 2.0 * s * h[1] * v[1],
        twice * w[1] * w[2] - w[1] * b2 - w[2] * b1 + s * (h[1] * v[2] + h[2] * v[1]),
        twice * w[2] * w[2] + same - 2.0 * w[2] * b2 + 2.0 * s * h[2] * v[2],
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
    """Pass the rotations on to the frames: Q <- Q R(w), w <- 0.

    frames (n, 9). x: coordinates, of node i x[6 i] .. x[6 i + 2] position, then w.
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
