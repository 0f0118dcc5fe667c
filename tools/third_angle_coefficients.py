#!/usr/bin/python3
"""Prints the coefficients of material/willam_warnke.hpp: cos((2/3) acos w) on 0 <= w <= 1 as a polynomial in 2w - 1,
by Chebyshev interpolation in fifty digits, and the largest error of its evaluation in double precision."""
import mpmath as mp

DEGREE = 18
mp.mp.dps = 50


def target(w):
    return mp.cos(mp.mpf(2) / 3 * mp.acos(w))


def chebyshev(degree, points=60):
    angles = [mp.pi * (k + mp.mpf(1) / 2) / points for k in range(points)]
    values = [target((mp.cos(t) + 1) / 2) for t in angles]
    c = [2 / mp.mpf(points) * sum(v * mp.cos(j * t) for v, t in zip(values, angles)) for j in range(degree + 1)]
    c[0] /= 2
    return c


def to_powers(c):
    previous, current = [mp.mpf(1)], [mp.mpf(0), mp.mpf(1)]
    powers = [mp.mpf(0)] * len(c)
    for j, cj in enumerate(c):
        for i, a in enumerate(previous):
            powers[i] += cj * a
        following = [mp.mpf(0)] + [2 * a for a in current]
        for i, a in enumerate(previous):
            following[i] -= a
        previous, current = current, following
    return [float(a) for a in powers]


coefficients = to_powers(chebyshev(DEGREE))
worst = 0
for k in range(4001):
    w, value = k / 4000, 0.0
    for a in reversed(coefficients):
        value = value * (2 * w - 1) + a
    worst = max(worst, abs(mp.mpf(value) - target(mp.mpf(w))))
print(",\n".join(repr(a) for a in coefficients))
print("largest error", float(worst))
