"""Corrects the strain measures of a bent element: lengths of arcs in place of chords.

If an element is bent to a circle and turns by phi from one side to the other, the differences of
its positions and of its directors are chords, short by the factor sin(phi / 2) / (phi / 2). The
three measures along s are products of two such differences, short by 1 - phi^2 / 12 + .., and phi
is h_s B11 where the element is hardly stretched. To that order the arc has

    A11 + q,  B11 (1 + q),  D11 (1 + q),   q = h_s^2 B11^2 / 12

and the same along z. These replace A11, B11, D11, less their values at rest. For small bending, q
is the square of the slope by which a deflected plate leaves its chord; without it the plate would
buckle at too high a load.
"""

from kernels.compile.jit import jit

TWELFTH = 1.0 / 12.0


@jit
def lengthen(size, rest, m):
    """Replace the measures ``m`` (9,) of chords by measures of arcs, both less the measures at
    ``rest`` (9,).

    size: h_s, h_z in m. Return B11, D11, B22, D22 of the chords, which the derivatives need.
    """
    chords = (m[3] + rest[3], m[6] + rest[6], m[4] + rest[4], m[7] + rest[7])
    for k in range(2):
        part = TWELFTH * size[k] * size[k]
        b, d, b0, d0 = chords[2 * k], chords[2 * k + 1], rest[3 + k], rest[6 + k]
        q, q0 = part * b * b, part * b0 * b0
        m[k] += q - q0
        m[3 + k] += q * b - q0 * b0
        m[6 + k] += q * d - q0 * d0
    return chords


@jit
def lengthen_rest(size, m):
    """Replace the measures ``m`` (9,) of chords at rest by measures of arcs."""
    for k in range(2):
        q = TWELFTH * size[k] * size[k] * m[3 + k] * m[3 + k]
        m[k] += q
        m[3 + k] *= 1.0 + q
        m[6 + k] *= 1.0 + q


@jit
def _factors(size, chords, k):
    """Return dA/dB, dB/dB, dD/dB and dD/dD in direction ``k``."""
    part, b, d = TWELFTH * size[k] * size[k], chords[2 * k], chords[2 * k + 1]
    return 2.0 * part * b, 1.0 + 3.0 * part * b * b, 2.0 * part * b * d, 1.0 + part * b * b


@jit
def pull_back(size, chords, slope):
    """Transform the slopes (9,) of an energy from measures of arcs to measures of chords."""
    for k in range(2):
        ab, bb, db, dd = _factors(size, chords, k)
        slope[3 + k] = ab * slope[k] + bb * slope[3 + k] + db * slope[6 + k]
        slope[6 + k] *= dd


@jit
def pull_back_second(size, chords, slope, second):
    """Transform the second derivatives (9, 9) in the same way; slope: slopes in measures of
    arcs.
    """
    for k in range(2):
        ab, bb, db, dd = _factors(size, chords, k)
        for i in range(9):
            second[3 + k, i] = ab * second[k, i] + bb * second[3 + k, i] + db * second[6 + k, i]
            second[6 + k, i] *= dd
        for i in range(9):
            second[i, 3 + k] = ab * second[i, k] + bb * second[i, 3 + k] + db * second[i, 6 + k]
            second[i, 6 + k] *= dd
        twice, b, d = 2.0 * TWELFTH * size[k] * size[k], chords[2 * k], chords[2 * k + 1]
        second[3 + k, 3 + k] += twice * (slope[k] + 3.0 * b * slope[3 + k] + d * slope[6 + k])
        second[3 + k, 6 + k] += twice * b * slope[6 + k]
        second[6 + k, 3 + k] += twice * b * slope[6 + k]
