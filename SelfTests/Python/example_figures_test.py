"""The figures that the examples print, in closed form."""
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")
sys.path.insert(0, str(Path(__file__).parents[2] / "Tools/Python/Examples"))


def segment(degrees, radius=0.03, spacing=2e-4, below=0.0):
    """Points of a lattice in a drum that is filled up to a plane, so far below the axis (m), turned by an angle."""
    along = np.arange(-radius, radius, spacing) + spacing / 2
    u, w = (a.ravel() for a in np.meshgrid(along, along))
    inside = (u**2 + w**2 < radius**2) & (w < -below)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return c * u[inside] - s * w[inside], s * u[inside] + c * w[inside]


@pytest.mark.parametrize("degrees", [-20.0, 12.0, 30.0])
@pytest.mark.parametrize("below", [0.0, 0.01])
def test_a_plane_surface_in_a_drum_has_one_angle(degrees, below):
    from drum import centre_angle, surface_angle

    x, z = segment(degrees, below=below)
    assert centre_angle(x, z, np.ones_like(x)) == pytest.approx(degrees, abs=1e-9)  # symmetric about it, as the lattice is
    # A strip has points of many rows; its highest one is within a spacing of the surface: 2e-4 m over the reach of 0.015 m, with
    # pairs that are half of that apart in the median.
    assert surface_angle(x, z) == pytest.approx(degrees, abs=np.degrees(2e-4 / 0.0075))


def test_a_line_through_all_grains_is_not_the_surface():
    """Of a half-full drum at 30 degrees it has 20.83 (in closed form), by which the drum was once described."""
    x, z = segment(30)
    assert np.degrees(np.arctan(np.polyfit(x, z, 1)[0])) == pytest.approx(20.8334, abs=0.05)


def test_stray_grains_do_not_turn_the_surface():
    """Theil and Sen: three of 14 strips with a grain high above leave 55 of 91 pairs, more than half, at the right slope."""
    from drum import GRAIN, surface_angle

    x = (np.arange(-7, 7) + 0.5) * GRAIN
    z = np.tan(np.radians(25)) * x
    z[::5] += 0.01
    assert surface_angle(x, z) == pytest.approx(25, abs=1e-9)
    assert abs(np.degrees(np.arctan(np.polyfit(x, z, 1)[0])) - 25) > 1


def test_the_flow_of_white_noise():
    """A mass whose increments are independent: the flow is within its error of the true one, in the mean over 200 runs, and the
    error is that of the increments, s sqrt(N) / T; the one that a fitted line claims is many times smaller."""
    from hopper import flow_of

    random, dt, flow, spread = np.random.default_rng(1), 0.01, 2.0, 0.3
    found = []
    for _ in range(200):
        mass = np.append(0, np.cumsum(dt * flow + dt * spread * random.standard_normal(400)))
        found.append(flow_of(dt * np.arange(401), mass))
    flows, errors = np.transpose(found)
    right = spread / np.sqrt(0.9 * 400)  # after the first tenth
    assert flows.mean() == pytest.approx(flow, abs=4 * right / np.sqrt(200))
    assert flows.std() == pytest.approx(right, rel=4 / np.sqrt(2 * 200))  # four of its standard errors
    assert errors.mean() == pytest.approx(right, rel=0.05)  # 19 degrees of freedom: 0.987 in the mean, +- 0.012
    time, mass = dt * np.arange(401), np.append(0, np.cumsum(dt * flow + dt * spread * random.standard_normal(400)))
    claimed = np.sqrt(np.polyfit(time, mass, 1, cov=True)[1][0, 0])
    assert claimed < right / 5


def test_the_angle_of_a_cone():
    """Centres that are even in a cone: by its moments, above its foot."""
    pytest.importorskip("scipy")
    from calibration import angle_of

    height, radius, foot = 4e-3, 12e-3, 1.2e-3
    along = (np.arange(-60, 60) + 0.5) * radius / 60
    x, y, z = (a.ravel() for a in np.meshgrid(along, along, (np.arange(200) + 0.5) * height / 200))
    inside = np.hypot(x, y) < radius * (1 - z / height)
    angle = angle_of(x[inside], y[inside], z[inside] + foot, foot)
    assert angle == pytest.approx(np.degrees(np.arctan(height / radius)), abs=0.05)
