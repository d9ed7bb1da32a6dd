#!/usr/bin/env python3
"""Restitution over the speed of an impact, dry and wet: all collisions of a chart in one call, beside the closed form.

The liquid bridge of Willett et al. (2000), Langmuir 16, 9396, in its simple form, pulls with F(S) = F(0) / (1 + 2.1 s + 10
s^2), where s = S / sqrt(4 V / R), up to the gap at which it ruptures, S = (1 + angle/2) (V*^(1/3) + V*^(2/3) / 10) R. Its
work W is what the grains lose besides the dashpot: e_wet = sqrt(e_dry^2 - 2 W / (m v^2)), with the reduced mass m, and 0
where the bridge holds them.

    restitution.py [--output FOLDER]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular

RADIUS, DENSITY, RESTITUTION = 1e-3, 2500, 0.8  # m, kg/m^3, 1
TENSION, ANGLE = 0.072, 0.2  # N/m, rad
GLASS = dict(density=DENSITY, young_modulus=1e7, poisson_ratio=0.25, restitution_coefficient=RESTITUTION)


def rupture_work(volume):
    """J, the integral of F(S) up to the rupture, for a volume (m^3)."""
    if volume == 0:
        return 0.0
    scale = np.sqrt(4 * volume / RADIUS)  # m
    share = np.cbrt(volume) / RADIUS
    longest = (1 + ANGLE / 2) * (share + share**2 / 10) * RADIUS / scale
    root = np.sqrt(4 * 10 - 2.1**2)
    integral = 2 / root * (np.arctan((20 * longest + 2.1) / root) - np.arctan(2.1 / root))
    return 2 * np.pi * RADIUS * TENSION * np.cos(ANGLE) * scale * integral


def closed_form(speed, volume):
    mass = 0.5 * 4 / 3 * np.pi * RADIUS**3 * DENSITY  # kg, reduced
    return np.sqrt(np.maximum(RESTITUTION**2 - 2 * rupture_work(volume) / (mass * speed**2), 0))


def chart(speeds, volumes):
    """Rows of collisions for the volumes (m^3) of bridges, at the speeds (m/s), as pendular.collisions() returns them."""
    return pendular.collisions("HertzianViscoelasticLiquidBridgeWillett", radius=RADIUS, normal_velocity=speeds,
                               liquid_bridge_volume=np.asarray(volumes)[:, np.newaxis], surface_tension=TENSION,
                               contact_angle=ANGLE, **GLASS)


def main(arguments=None):
    options = argparse.ArgumentParser(description="Restitution over the speed of an impact, dry and wet.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    folder = options.parse_args(arguments).output
    if not folder.is_dir():
        options.error(f"--output: there is no folder {folder}.")
    speeds, volumes = np.geomspace(0.02, 2, 100), [0, 1e-12, 1e-11, 5e-11]
    found = chart(speeds, volumes)
    for volume, restitution, parted in zip(volumes, found["restitution"], found["parted"]):
        name = f"{1e12 * volume:g} nl" if volume else "dry"
        held = f"held below {speeds[~parted].max():.3f} m/s" if not parted.all() else "parts at all speeds"
        print(f"{name}: {held}, restitution {restitution[-1]:.3f} at {speeds[-1]:g} m/s")
        line, = plt.semilogx(speeds, closed_form(speeds, volume), lw=1)
        plt.semilogx(speeds, restitution, "o", ms=3, color=line.get_color(), label=name)
    plt.xlabel("impact speed, m/s"), plt.ylabel("restitution (lines: closed form)"), plt.legend()
    plt.savefig(folder / "restitution.png")


if __name__ == "__main__":
    main()
