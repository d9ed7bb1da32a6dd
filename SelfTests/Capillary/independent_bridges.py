"""Writes IndependentBridges.h: liquid bridges at 40 digits, by a method that shares nothing with the solver it tests.

The Young-Laplace equation in arc length, x' = cos psi, y' = sin psi, psi' = cos psi / y - 2 H, with volume
V' = pi y^2 cos psi and area A' = 2 pi y, is integrated by Taylor series of order 36 whose steps keep the last term
below 1e-42; Newton's method with differences solves for contact radius, angle, mean curvature and arc length until
the residual is below 1e-34. Needs mpmath. Usage: python3 independent_bridges.py > IndependentBridges.h
"""
from mpmath import mp, mpf, pi, cos, sin, fdot, polyval, isinf, matrix, lu_solve, norm, nstr

mp.dps = 40
ORDER = 36

# Radius and contact angle of both bodies, volume, gap; then a start: contact radius and tangent angle at the first
# body, mean curvature, arc length. Lengths in any unit, angles in rad.
CASES = [
    ('1.0', '0.0', '1.0', '0.0', '0.01', '0.0', '0.31153723', '-1.253986', '-8.1123226', '0.13297333'),
    ('1.0', '0.0', '1.0', '0.0', '0.1', '0.4', '0.47884992', '-1.0714521', '0.10110919', '0.87931748'),
    ('1.0', '0.5', '1.0', '0.5', '0.001', '0.05', '0.088998043', '-0.98168038', '-8.751626', '0.069343127'),
    ('1.0', '1.0', '1.0', '1.0', '0.3', '0.3', '0.48374808', '-0.06586415', '0.92648028', '0.55000354'),
    ('1.0', '2.0', '1.0', '2.0', '0.1', '0.1', '0.37727955', '0.81606067', '4.0304608', '0.27686974'),
    ('0.75', '0.25', '1.5', '0.25', '0.05', '0.2', '0.30820335', '-0.89731383', '-1.0650878', '0.37742624'),
    ('0.625', '0.0', '2.5', '0.0', '0.0001', '0.02', '0.04787171', '-1.4941265', '-34.717637', '0.035633479'),
    ('0.5', '0.75', 'inf', '0.75', '0.02', '0.1', '0.22149649', '-0.36186197', '-1.5103823', '0.16681254'),
    ('0.5', '0.0', 'inf', '1.5', '0.25', '0.25', '0.49379154', '-0.15775106', '0.90927876', '0.6740565'),
    ('1.0', '2.5', '2.0', '1.5', '0.5', '0.125', '0.5137404', '1.4687425', '2.1445494', '0.55118398'),
    ('1.0', '2.5', '2.0', '0.5', '0.5', '0.0625', '0.43771653', '1.3822611', '0.90474782', '0.80042183'),
    ('1.0', '1.5', '4.0', '3.0', '0.05', '0.0625', '0.39439333', '0.33461125', '5.3734101', '0.20884415'),
    ('1.0', '0.0', '1.0', '0.0', '1e-06', '0.001', '0.01721897', '-1.5535765', '-747.68678', '0.0020259699'),
    ('1.0', '0.125', '1.25', '0.125', '5.0', '0.5', '0.99877818', '0.075561703', '0.45207102', '2.5222419'),
    ('0.5', '0.0', 'inf', '0.0', '0.25', '0.46875', '0.31422863', '-0.89122805', '-0.16344488', '1.3232356'),
    ('1.0', '1.25', '1.0', '1.25', '10.0', '0.5', '0.97860966', '1.0427946', '0.7206063', '2.5035087'),
    ('1.0', '0.0', '3.0', '0.0', '1e-12', '1e-05', '0.00018228295', '-1.570614', '-97576.677', '1.5808811e-05'),
    ('0.03125', '0.5', 'inf', '0.5', '1e-06', '0.0078125', '0.0072134213', '-0.83786623', '-23.148262', '0.010613319'),
    ('inf', '1.0', 'inf', '2.0', '1.0', '0.5', '0.94545292', '-0.57079633', '0.42893878', '0.57788111'),
    ('1.0', '3.140625', '1.0', '3.140625', '0.1', '0.25', '0.20495949', '1.776251', '4.5545817', '0.48694255'),
]


def series(start, curvature):
    """Taylor coefficients of x, y, psi, V, A."""
    x, y, psi, volume, area = [[value] for value in start]
    cosine, sine, inverse, square = [cos(psi[0])], [sin(psi[0])], [1 / y[0]], []
    product = lambda a, b, n: fdot([(a[k], b[n - k]) for k in range(n + 1)])
    for n in range(ORDER):
        square.append(product(y, y, n))
        x.append(cosine[n] / (n + 1))
        y.append(sine[n] / (n + 1))
        psi.append((product(cosine, inverse, n) - (2 * curvature if n == 0 else 0)) / (n + 1))
        volume.append(pi * product(square, cosine, n) / (n + 1))
        area.append(2 * pi * y[n] / (n + 1))
        m = n + 1
        cosine.append(-fdot([(k * psi[k], sine[m - k]) for k in range(1, m + 1)]) / m)
        sine.append(fdot([(k * psi[k], cosine[m - k]) for k in range(1, m + 1)]) / m)
        inverse.append(-fdot([(y[k], inverse[m - k]) for k in range(1, m + 1)]) / y[0])
    return x, y, psi, volume, area


def shoot(y, psi, curvature, length):
    state = [mpf(0), y, psi, mpf(0), mpf(0)]
    while length > 0:
        terms = series(state, curvature)
        largest = min((mpf(10) ** -42 * (abs(a[0]) + 1) / (abs(a[ORDER]) + mpf(10) ** -60)) ** (mpf(1) / ORDER)
                      for a in terms[1:3])
        step = min(length, largest * mpf('0.8'))
        state = [polyval(a[::-1], step) for a in terms]
        length -= step
    return state


def cap(curvature, y, cosine):
    height = y * y * curvature / (1 + cosine) if cosine > 0 else (1 - cosine) / curvature
    return height, pi * height * (3 * y * y + height * height) / 6, pi * (y * y + height * height)


def solve(case):
    r1, t1, r2, t2, volume, gap, y, psi, curvature, length = case
    k1, k2 = (0 if isinf(r) else 1 / r for r in (r1, r2))

    def residual(z):
        beta1 = z[1] + pi / 2 - t1
        x, y2, psi2, filled, area = shoot(*z)
        beta2 = pi / 2 - t2 - psi2
        cap1, cap2 = cap(k1, z[0], cos(beta1)), cap(k2, y2, cos(beta2))
        opening = x - cap1[0] - cap2[0]
        errors = [k1 * z[0] - sin(beta1), k2 * y2 - sin(beta2), opening / gap - 1 if gap > 0 else opening,
                  (filled - cap1[1] - cap2[1]) / volume - 1]
        return errors, area, area - cos(t1) * cap1[2] - cos(t2) * cap2[2]

    z = [y, psi, curvature, length]
    while True:
        errors, area, energy = residual(z)
        if norm(errors) < mpf(10) ** -34:
            break
        jacobian = matrix(4, 4)
        for j in range(4):
            step = mpf(10) ** -20 * (abs(z[j]) + mpf(10) ** -3)
            moved = [value + (step if i == j else 0) for i, value in enumerate(z)]
            for i, value in enumerate(residual(moved)[0]):
                jacobian[i, j] = (value - errors[i]) / step
        z = [a + b for a, b in zip(z, lu_solve(jacobian, -matrix(errors)))]
    return 2 * pi * (z[0] * cos(z[1]) - z[2] * z[0] ** 2), 2 * z[2], area, energy


print("""#pragma once

// Written by independent_bridges.py; not by hand, and not from the code it tests. Rounded to 20 digits.

#include <limits>

namespace pendular::independent {

struct Bridge {
    double firstRadius, firstAngle, secondRadius, secondAngle, volume, gap;
    double force, pressure, lateralArea, energy;  // divided by the surface tension
};

inline constexpr double plane = std::numeric_limits<double>::infinity();

inline constexpr Bridge bridges[] = {""")
for case in CASES:
    inputs = ", ".join("plane" if v == "inf" else v for v in case[:6])
    print("    {%s,\n     %s}," % (inputs, ", ".join(nstr(v, 20) for v in solve([mpf(float(v)) for v in case]))))
print("""};

}  // namespace pendular::independent""")
