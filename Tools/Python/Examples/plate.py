#!/usr/bin/env python3
"""A host: an elastic plate by finite elements of one's own carries a layer of grains.

The plate is clamped at both ends and bends along x: Euler's beams with a deflection and a slope at each node, in time by
Newmark's average acceleration. Grains see a strip for each element, which moves with the two nodes of it: every few steps the
plate gets the forces on the strips, and gives them velocities.

    plate.py [--output FOLDER] [--time S]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular

LENGTH, WIDTH, THICKNESS = 0.06, 0.008, 1e-3  # m
YOUNG, DENSITY, DAMPING = 6e7, 3000, 300      # Pa, kg/m^3, 1/s: rubber with a filler
ELEMENTS, GRAIN = 12, 2e-3                    # m, the largest diameter


class Plate:
    """Deflections (m) and slopes of all nodes, w[0], slope[0], w[1], ..."""

    def __init__(self):
        self.h = h = LENGTH / ELEMENTS
        self.bending = YOUNG * WIDTH * THICKNESS**3 / 12  # N m^2
        k = self.bending / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                            [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
        m = DENSITY * WIDTH * THICKNESS * h / 420 * np.array([
            [156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
            [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
        size = 2 * ELEMENTS + 2
        self.stiffness, self.mass = np.zeros((size, size)), np.zeros((size, size))
        for e in range(ELEMENTS):
            own = np.s_[2 * e:2 * e + 4]
            self.stiffness[own, own] += k
            self.mass[own, own] += m
        self.free = np.arange(2, size - 2)  # the ends are clamped
        self.w, self.v, self.a = np.zeros((3, size))

    def step(self, load, dt):
        """Newmark's method with beta = 1/4, gamma = 1/2, which no dt makes unstable. load: N and N m of all nodes."""
        k, m = (matrix[np.ix_(self.free, self.free)] for matrix in (self.stiffness, self.mass))
        w, v, a = (values[self.free] for values in (self.w, self.v, self.a))
        w, v = w + dt * v + dt * dt / 4 * a, v + dt / 2 * a
        a = np.linalg.solve(m + dt / 2 * DAMPING * m + dt * dt / 4 * k, load[self.free] - DAMPING * m @ v - k @ w)
        self.w[self.free], self.v[self.free], self.a[self.free] = w + dt * dt / 4 * a, v + dt / 2 * a, a

    def at_rest(self, load):
        """The deflections (m) of the nodes under a load that does not change."""
        w = np.zeros_like(self.w)
        w[self.free] = np.linalg.solve(self.stiffness[np.ix_(self.free, self.free)], load[self.free])
        return w[::2]


def couple(scene, strips, plate, steps=4):
    """Every so many steps, which must be short against a contact (25 steps): what the plate feels is as old as that.

    The load (N and N m of all nodes) is in `plate.load` then.
    """
    middle = plate.h * (np.arange(ELEMENTS) + 0.5)

    def exchange(scene):
        plate.load = np.zeros_like(plate.w)
        for k, strip in enumerate(strips):  # F and M about the middle are F/2 + M/h and F/2 - M/h at the nodes
            push, turn = strip.force[2], strip.torque[1]
            plate.load[2 * k] += push / 2 + turn / plate.h
            plate.load[2 * k + 2] += push / 2 - turn / plate.h
        before, dt = plate.w.copy(), steps * scene.time_step
        plate.step(plate.load, dt)
        speed = (plate.w - before)[::2] / dt
        for k, strip in enumerate(strips):
            strip.set_velocity((0, 0, (speed[k] + speed[k + 1]) / 2))
            height = (before[2 * k] + before[2 * k + 2]) / 2
            strip.set_angular_velocity((0, (speed[k] - speed[k + 1]) / plate.h, 0), point=(middle[k], 0, height))

    scene.every_steps(steps, exchange)


def make_scene():
    """A layer of grains above the strips, which repeats itself along y, and the strips."""
    scene = pendular.Scene()
    glass = scene.add_species("HertzianViscoelasticMindlinIncremental", density=2500, young_modulus=2e6, poisson_ratio=0.25,
                              restitution_coefficient=0.3, sliding_friction_coefficient=0.4)
    smooth = scene.add_species("HertzianViscoelasticMindlinIncremental", density=2500, young_modulus=2e6, poisson_ratio=0.25,
                               restitution_coefficient=0.3, sliding_friction_coefficient=0)
    scene.set_pair(glass, smooth, sliding_friction_coefficient=0)
    scene.set_periodic("y", 0, WIDTH)
    scene.add_plane(smooth, (-1, 0, 0), (0, 0, 0)), scene.add_plane(smooth, (1, 0, 0), (LENGTH, 0, 0))
    edges, strips = np.linspace(0, LENGTH, ELEMENTS + 1), []
    for a, b in zip(edges, edges[1:]):
        corners = np.array([[a, 0, 0], [b, 0, 0], [b, WIDTH, 0], [a, WIDTH, 0]])
        strips.append(scene.add_mesh(glass, corners[[[0, 1, 2], [0, 2, 3]]]))
        strips[-1].keep_forces(about=((a + b) / 2, 0, 0))
    scene.insert(glass, pendular.even_sizes(0.8 * GRAIN, GRAIN),
                 pendular.box((0, 0, 1e-4), (LENGTH, WIDTH, 6 * GRAIN)), solid_fraction=0.4)
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    return scene, strips


def main(arguments=None):
    options = argparse.ArgumentParser(description="A layer of grains on an elastic plate.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    options.add_argument("--time", type=float, default=0.2, help="s")
    given = options.parse_args(arguments)
    scene, strips = make_scene()
    plate = Plate()
    couple(scene, strips, plate)
    scene.run(given.time, progress=True)
    even = scene.total_mass * 9.81 * LENGTH**3 / (384 * plate.bending)  # q L^4 / (384 E I)
    print(f"the middle is {-1e3 * plate.w[::2].min():.3f} mm below the ends; an even load makes {1e3 * even:.3f} mm")
    axes = pendular.draw(scene, color="radius_m")
    axes.plot(np.linspace(0, LENGTH, ELEMENTS + 1), plate.w[::2], "k")
    axes.autoscale_view()
    axes.figure.savefig(given.output / "plate.png")


if __name__ == "__main__":
    main()
