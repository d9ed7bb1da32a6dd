#!/usr/bin/env python3
"""A drum from a mesh turns; the slope of its bed is drawn while it runs (in a window, or in a notebook).

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


def slope(scene):
    """degrees, of the straight line through all grains"""
    x = scene.position
    return np.degrees(np.arctan(np.polyfit(x[:, 0], x[:, 2], 1)[0]))


def make_drum(mesh=None, scale=1.0, speed=3.0):
    scene = pendular.Scene()
    glass = scene.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                              restitution_coefficient=0.5, sliding_friction_coefficient=0.5)
    drum = scene.add_mesh(glass, drum_mesh() if mesh is None else mesh, scale=scale)
    region = pendular.box((-0.6 * RADIUS, -0.45 * LENGTH, -0.7 * RADIUS), (0.6 * RADIUS, 0.45 * LENGTH, 0.5 * RADIUS))
    scene.insert(glass, pendular.even_sizes(0.8 * GRAIN, GRAIN), region, solid_fraction=0.4)
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
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
    line, = axes.plot([], [])
    axes.set(xlabel="time, s", ylabel="slope of the bed, degrees", xlim=(0.1, 0.1 + given.time), ylim=(-10, 60))
    times, slopes = [], []

    def draw(scene):
        times.append(scene.time), slopes.append(slope(scene))
        line.set_data(times, slopes)
        figure.canvas.draw_idle(), figure.canvas.flush_events()

    scene.every_time(0.02, draw)
    scene.run(0.1 + given.time, progress=True)
    figure.savefig(given.output / "drum.png")
    print(f"{len(scene)} grains, slope at the end {slopes[-1]:.1f} degrees")


if __name__ == "__main__":
    main()
