#!/usr/bin/env python3
"""A host: a steel ball hits an elastic plate, which its modes compute, and leaves most of its energy in waves.

The plate is simply supported and thin (Kirchhoff): w = sum of q_mn sin(m pi x/a) sin(n pi y/b), each mode an oscillator of
a quarter of the plate's mass. Grains see a patch of triangles around the place that is hit, whose vertices go with w; what
they give to the vertices is the force on the modes. The deformation at the point of contact is Hertz' law of the contact.
Beside it Zener's rebound from a plate without end (C. Zener, Phys. Rev. 59 (1941) 669), and the energy of both sides.

    impact.py [--output FOLDER] [--modes N] [--steps-between N]
"""
import argparse
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular


@dataclass(frozen=True)
class Material:
    young_modulus: float  # Pa
    poisson_ratio: float
    density: float        # kg/m^3


STEEL = Material(210e9, 0.3, 7800)


class Plate:
    """Rectangle from the origin to (length, width), m, hit at `spot`; deflections along z are positive upwards."""

    def __init__(self, length=0.5, width=0.5, thickness=4e-3, material=STEEL, spot=(0.25, 0.25), modes=160):
        self.material, self.thickness, self.spot = material, thickness, spot
        self.bending = material.young_modulus * thickness**3 / (12 * (1 - material.poisson_ratio**2))  # N m
        self.modal_mass = material.density * thickness * length * width / 4
        number = np.arange(1, modes + 1) * np.pi
        self.kx, self.ky = number / length, number / width
        self.frequency = np.sqrt(self.bending / (material.density * thickness)) * (
            self.kx[:, None]**2 + self.ky[None, :]**2)                                                 # rad/s
        self.q, self.speed = np.zeros((2, modes, modes))

    def patch(self, radius, cells=10):
        """Vertices and triangles of a square of this half width around the spot; the spot is a vertex."""
        along = np.linspace(-radius, radius, 2 * cells + 1)
        x, y = along + self.spot[0], along + self.spot[1]
        self.sines_x, self.sines_y = np.sin(np.outer(x, self.kx)), np.sin(np.outer(y, self.ky))
        grid = np.stack(np.meshgrid(x, y, [0.0], indexing="ij"), -1).reshape(-1, 3)
        number = np.arange(len(grid)).reshape(len(x), len(y))
        a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        return grid, np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])

    def middle(self, vertices):
        """The number of the vertex at the spot."""
        return len(vertices) // 2

    def deflection(self):
        """m, of the vertices of the patch."""
        return (self.sines_x @ self.q @ self.sines_y.T).reshape(-1)

    def advance(self, force, time):
        """Each mode exactly, for forces (N) on the vertices that do not change in this time (s)."""
        load = self.sines_x.T @ force.reshape(len(self.sines_x), -1) @ self.sines_y
        at_rest = load / (self.modal_mass * self.frequency**2)
        cosine, sine = np.cos(self.frequency * time), np.sin(self.frequency * time)
        off = self.q - at_rest
        self.q, self.speed = (at_rest + off * cosine + self.speed / self.frequency * sine,
                              self.speed * cosine - off * self.frequency * sine)

    def energy(self):
        """J"""
        return self.modal_mass / 2 * (self.speed**2 + (self.frequency * self.q)**2).sum()


@dataclass
class Ball:
    radius: float = 0.01  # m
    material: Material = STEEL
    speed: float = 1.0    # m/s, downwards

    @property
    def mass(self):
        return 4 / 3 * np.pi * self.radius**3 * self.material.density


def hertz_stiffness(ball, plate):
    """K of F = K overlap^(3/2), and the time (s) T = (m / (K sqrt(v)))^(2/5)."""
    modulus = 1 / sum((1 - m.poisson_ratio**2) / m.young_modulus for m in (ball.material, plate.material))
    stiffness = 4 / 3 * modulus * np.sqrt(ball.radius)
    return stiffness, (ball.mass / (stiffness * np.sqrt(ball.speed)))**0.4


def hit(plate, ball, steps_between=1, steps_in_hertz_time=1500):
    """Rows of time (s), force (N), velocity of the ball, deflection (m), and energies of ball and plate (J)."""
    scene = pendular.Scene()
    species = [scene.add_species("HertzianViscoelastic", density=m.density, young_modulus=m.young_modulus,
                                 poisson_ratio=m.poisson_ratio, restitution_coefficient=1)
               for m in (ball.material, plate.material)]
    duration = hertz_stiffness(ball, plate)[1]
    scene.time_step = duration / steps_in_hertz_time
    gap = 10 * ball.speed * scene.time_step
    scene.add_grains(species[0], [[*plate.spot, ball.radius + gap]], ball.radius, velocity=[[0, 0, -ball.speed]])
    vertices, triangles = plate.patch(2 * ball.radius)
    wall = scene.add_host_wall(species[1], vertices, triangles)
    middle, interval, rows = plate.middle(vertices), steps_between * scene.time_step, []

    def exchange(scene):
        velocity = scene.velocity[0, 2]
        force = wall.vertex_impulses[:, 2] / interval  # their means since the last exchange
        rows.append((scene.time, -force.sum(), velocity, wall.vertices[middle, 2],
                     ball.mass / 2 * velocity**2, plate.energy()))
        plate.advance(force, interval)
        places = vertices.copy()
        places[:, 2] = plate.deflection()
        wall.set_vertex_targets(places, interval)
        if rows[-1][1] == 0 and max(row[1] for row in rows[-50:]) > 0 and velocity > -ball.speed:
            return False  # they have parted

    scene.every_steps(steps_between, exchange)
    scene.run(10 * duration)
    return np.array(rows).T


def zener(plate, ball, steps=20000):
    """The share of the speed that a plate without end leaves: s'' + (1 + lambda d/dt) s^(3/2) = 0, by Runge and Kutta."""
    _, time = hertz_stiffness(ball, plate)
    loss = ball.mass / (8 * time * np.sqrt(plate.material.density * plate.thickness * plate.bending))

    def rate(s, v):
        return v, -(max(s, 0)**1.5 + 1.5 * loss * np.sqrt(max(s, 0)) * v)

    # The velocity of the ball is that of the approach and of the plate, v + loss s^(3/2), which ends at s = 0.
    s, v, h = 0.0, 1.0, 20 / steps
    while s >= 0:
        a = rate(s, v)
        b = rate(s + h / 2 * a[0], v + h / 2 * a[1])
        c = rate(s + h / 2 * b[0], v + h / 2 * b[1])
        d = rate(s + h * c[0], v + h * c[1])
        before = s, v
        s, v = (x + h / 6 * (k + 2 * l + 2 * m + n) for x, k, l, m, n in zip(before, a, b, c, d))
    return loss, -(before[1] + (v - before[1]) * before[0] / (before[0] - s))


def main(arguments=None):
    options = argparse.ArgumentParser(description="A steel ball hits an elastic plate.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    options.add_argument("--modes", type=int, default=160, help="along each side")
    options.add_argument("--steps-between", type=int, default=1, help="steps from one exchange to the next")
    given = options.parse_args(arguments)
    plate, ball = Plate(modes=given.modes), Ball()
    time, force, velocity, deflection, of_ball, of_plate = hit(plate, ball, given.steps_between)
    loss, endless = zener(plate, ball)
    print(f"rebound {velocity[-1] / ball.speed:.4f}, of a plate without end {endless:.4f} (lambda {loss:.3f}); "
          f"largest force {force.max():.1f} N; energy off by {(of_ball + of_plate)[-1] / of_ball[0] - 1:.1e}")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    left.plot(1e6 * time, force), left.set_xlabel("time, µs"), left.set_ylabel("force, N")
    right.plot(1e6 * time, 1e3 * of_ball, label="ball"), right.plot(1e6 * time, 1e3 * of_plate, label="plate")
    right.set_xlabel("time, µs"), right.set_ylabel("energy, mJ"), right.legend()
    figure.savefig(given.output / "impact.png")


if __name__ == "__main__":
    main()
