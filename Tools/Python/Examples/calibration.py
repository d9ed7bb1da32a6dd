#!/usr/bin/env python3
"""Calibration: a friction and a rolling friction at which a heap has a measured angle of repose and width.

The search finds *a* pair that meets both measurements within the scatter of heaps, not *the* pair: angle and width of one heap
hardly identify sliding friction. By a posterior over sliding from 0.05 to 1 and rolling from 0 to 0.5 they leave sliding a 90 %
interval as wide as 0.85 of that of the prior, and the pair that this search returns errs by 1.13 of the prior's standard
deviation. So meet another test, which you have held back, before you use the numbers. What heaps give is noisy, so that slopes
of it mislead; the simplex of Nelder and Mead (1965), Comput. J. 7, 308, asks for none, and begins large.

    calibration.py [--angle DEGREES] [--width M] [--evaluations N]
"""
import argparse

import numpy as np
from scipy.optimize import minimize

import pendular


BASE, GRAIN = 0.9e-3, 0.95e-3  # m, radii: of the grains of the base, and the mean of the heap's
SPACING = 2e-3  # m, of the base, a square lattice
# m, of centres that lie on the base, each on four of its grains: the foot of the heap, as z = r is on a floor
FOOT = np.sqrt((BASE + GRAIN)**2 - SPACING**2 / 2)


def angle_of(x, y, z, foot=FOOT):
    """degrees: of the cone that has the moments of these centres, tan = 4 <z> / sqrt(10 <r^2> / 3), above its foot (m)"""
    return np.degrees(np.arctan2(4 * (z.mean() - foot), np.sqrt(10 / 3 * (x**2 + y**2).mean())))


def heap(friction, rolling, seed=1, time=0.25):
    """The angle (degrees, by moments) and the width (m, root mean square of the distances from the axis) of a heap."""
    scene = pendular.Scene()
    # Mindlin, not MindlinIncremental: only the angle and the width of the heap count, bulk quantities.
    sand = scene.add_species("HertzianViscoelasticMindlinRollingTorsion", density=2500, young_modulus=2e6,
                             poisson_ratio=0.25, restitution_coefficient=0.3, sliding_friction_coefficient=friction,
                             rolling_stiffness=1e3, rolling_dissipation=1e-4, rolling_friction_coefficient=rolling,
                             # The lever of torsion is twice that of rolling in this law: these are the same torques.
                             torsion_stiffness=1e3 / 4, torsion_dissipation=1e-4 / 4,
                             torsion_friction_coefficient=rolling / 2)
    scene.add_plane(sand, (0, 0, -1), (0, 0, 0))
    base = np.stack(np.meshgrid(np.arange(-9, 10), np.arange(-9, 10), [0]), -1).reshape(-1, 3) * SPACING
    scene.add_grains(sand, base, BASE, fixed=True)
    scene.insert(sand, pendular.even_sizes(1.8e-3, 2e-3), pendular.cylinder((0, 0, 1.2e-3), (0, 0, 0.03), 5e-3),
                 solid_fraction=0.45, seed=seed)
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    scene.run(time)
    x = scene.position[len(base):]
    # Of a cone of height h and radius R the mean height is h / 4, and the mean square of the distance 3 / 10 R^2. Moments of
    # all grains are less noisy than the line through the tops. The foot is that of the base: the lowest grain is noise.
    return angle_of(*x.T), np.sqrt((x[:, 0]**2 + x[:, 1]**2).mean())


def calibrate(angle, width, evaluations=20):
    """A friction and a rolling friction that meet both; an evaluation is two heaps."""
    def miss(numbers):
        found = np.array([heap(*numbers, seed=seed) for seed in (1, 2)]).mean(0)
        return ((found[0] - angle) / 1.0)**2 + ((found[1] - width) / 5e-4)**2  # over what two heaps differ by

    start = [(0.3, 0.05), (0.7, 0.05), (0.3, 0.25)]
    return minimize(miss, start[0], method="Nelder-Mead", bounds=((0.05, 1.0), (0.0, 0.5)),
                    options=dict(maxfev=evaluations, initial_simplex=start)).x


def main(arguments=None):
    options = argparse.ArgumentParser(description="Calibration against an angle of repose.")
    options.add_argument("--angle", type=float, default=12.0, help="degrees")
    options.add_argument("--width", type=float, default=11e-3, help="m")
    options.add_argument("--evaluations", type=int, default=20, help="of two heaps each")
    given = options.parse_args(arguments)
    found = calibrate(given.angle, given.width, given.evaluations)
    angle, width = heap(*found)
    print(f"friction {found[0]:.3f}, rolling friction {found[1]:.3f}: {angle:.1f} degrees, {1e3 * width:.2f} mm")


if __name__ == "__main__":
    main()
