#!/usr/bin/env python3
"""A drum from a mesh turns; the slope of its bed is drawn while it runs (in a window, or in a notebook).

Two angles, which agree where the surface is plane: by how much the centre of mass is turned from below the axis, exact for a
plane surface at any filling; and that of the surface, the median slope of all pairs of the highest grains of strips one grain
wide in the middle half of the drum (Theil and Sen). A straight line through all grains of a bed is not its surface: of a
half-full drum at 30 degrees it has 20.8.

    drum.py [--output FOLDER] [--mesh FILE --scale M] [--time S]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular

RADIUS, LENGTH, GRAIN = 0.03, 0.012, 2e-3  # m: of the drum, and the largest diameter


def drum_mesh(corners=48):
    """A closed drum along y, as triangles N x 3 x 3 (m)."""
    angle = np.linspace(0, 2 * np.pi, corners + 1)
    x, z, half = RADIUS * np.cos(angle), RADIUS * np.sin(angle), LENGTH / 2
    low, high = (np.stack([x, np.full_like(x, y), z], 1) for y in (-half, half))
    middle = np.array([[0, -half, 0], [0, half, 0]])
    a, b, c, d = low[:-1], low[1:], high[1:], high[:-1]
    ends = np.broadcast_to(middle[0], a.shape), np.broadcast_to(middle[1], a.shape)
    return np.concatenate([np.stack(t, 1) for t in ((a, b, c), (a, c, d), (ends[0], a, b), (ends[1], d, c))])


def centre_angle(x, z, mass):
    """degrees, by which the centre of mass is turned from below the axis, the origin"""
    return np.degrees(np.arctan2(mass @ x, -(mass @ z)))


def surface_angle(x, z, reach=RADIUS / 2, strip=GRAIN):
    """degrees: the median slope of all pairs of the highest centres of strips of this width (m), up to a distance (m) of x"""
    middle = np.abs(x) < reach
    number = np.floor(x[middle] / strip).astype(int)
    order = np.lexsort((z[middle], number))  # the last one of each number is the highest
    last = np.append(np.diff(number[order]) > 0, True)[:len(order)]
    x, z = x[middle][order][last], z[middle][order][last]
    a, b = np.triu_indices(len(x), 1)
    return np.degrees(np.arctan(np.median((z[b] - z[a]) / (x[b] - x[a])))) if len(a) else np.nan


def slope(scene):
    """degrees: the angle of the centre of mass, and that of the surface"""
    x = scene.position
    return centre_angle(x[:, 0], x[:, 2], scene.mass), surface_angle(x[:, 0], x[:, 2])


def make_drum(mesh=None, scale=1.0, speed=3.0):
    scene = pendular.Scene()
    # Mindlin, not MindlinIncremental: only the slope counts, a bulk quantity.
    glass = scene.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                              restitution_coefficient=0.5, sliding_friction_coefficient=0.5)
    drum = scene.add_mesh(glass, drum_mesh() if mesh is None else mesh, scale=scale)
    region = pendular.box((-0.6 * RADIUS, -0.45 * LENGTH, -0.7 * RADIUS), (0.6 * RADIUS, 0.45 * LENGTH, 0.5 * RADIUS))
    scene.insert(glass, pendular.even_sizes(0.8 * GRAIN, GRAIN), region, solid_fraction=0.4)
    scene.gravity = (0, 0, -9.81)
    scene.set_step_for(0.06, figure="friction")  # angles to 6 %, in a sixth of the time of choose_time_step()
    scene.run(0.1)  # it settles
    drum.set_angular_velocity((0, -speed, 0))
    return scene


def main(arguments=None):
    options = argparse.ArgumentParser(description="A drum turns.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    options.add_argument("--mesh", help="a file (STL, OBJ, PLY) in the place of the drum that is made here")
    options.add_argument("--scale", type=float, default=1.0, help="m, of one unit of the file")
    options.add_argument("--time", type=float, default=0.6, help="s, that it turns")
    given = options.parse_args(arguments)
    scene = make_drum(given.mesh, given.scale)
    figure, axes = plt.subplots()
    lines = [axes.plot([], [], label=name)[0] for name in ("of the centre of mass", "of the surface")]
    axes.legend()
    axes.set(xlabel="time, s", ylabel="slope of the bed, degrees", xlim=(0.1, 0.1 + given.time), ylim=(-10, 60))
    times, slopes = [], []

    def draw(scene):
        times.append(scene.time), slopes.append(slope(scene))
        for line, angles in zip(lines, np.transpose(slopes)):
            line.set_data(times, angles)
        figure.canvas.draw_idle(), figure.canvas.flush_events()

    scene.every_time(0.02, draw)
    scene.run(0.1 + given.time, progress=True)
    figure.savefig(given.output / "drum.png")
    centre, surface = slopes[-1]
    print(f"{len(scene)} grains, at the end the centre of mass has {centre:.1f} degrees, the surface {surface:.1f}")


if __name__ == "__main__":
    main()
