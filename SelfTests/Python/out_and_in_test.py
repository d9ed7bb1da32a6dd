"""What comes out of a scene goes in again."""
import numpy as np
import pytest

import pendular
from conftest import glass_in

# A rod along x, one along z, and one without a symmetry, in any unit.
SHAPES = [[[-1, 0, 0, 1], [1, 0, 0, 1]], [[0, 0, -1, 1], [0, 0, 1, 1]], [[0, 0, 0, 1], [1.5, 0.2, 0, 0.9], [0, 1, 0.4, 0.7]]]


@pytest.mark.parametrize("spheres", SHAPES)
def test_a_clump_comes_back_as_it_was_turned(spheres):
    scene = pendular.Scene()
    turn = np.array([0.9, 0.1, -0.3, 0.2])
    scene.add_shape(glass_in(scene), pendular.clump(spheres), (0, 0, 1), orientation=turn, scale=1e-3)
    found = scene.bodies()["orientation"][0]
    assert abs(found @ turn) / np.linalg.norm(turn) == pytest.approx(1, abs=1e-15)  # q and -q are one turn


def bed(species=None, clumps=()):
    scene = pendular.Scene(superquadrics=species) if species else pendular.Scene()
    glass = glass_in(scene)
    for axis in np.eye(3):
        scene.add_plane(glass, -axis, (0, 0, 0))
        scene.add_plane(glass, axis, (0.015, 0.015, 0.03))
    for number, shape in enumerate(clumps):
        scene.insert(glass, pendular.even_sizes(1.6e-3, 2.4e-3), pendular.box((0, 0, 0), (0.015, 0.015, 0.03)), number=20,
                     shape=shape, seed=number + 1)
    scene.gravity = (0, 0, -9.81)
    return scene, glass


@pytest.mark.parametrize("kind", ["clumps", "superquadrics"])
def test_a_bed_goes_out_and_in_again(kind):
    """A bed that has fallen and still moves: places, velocities and moments are the same to 1e-12 (some 20 roundings)."""
    shapes = [pendular.clump(s) for s in SHAPES] if kind == "clumps" else [pendular.superquadric((1e-3, 0.6e-3, 0.4e-3))]
    species = None if kind == "clumps" else "HertzianViscoelasticMindlin"
    scene, _ = bed(species, shapes)
    scene.time_step = 0.5 * scene.stability_limit()
    scene.run(0.02)
    out = scene.bodies()
    other, glass = bed(species)
    for k in range(len(out["body"])):
        shape = shapes[k // 20]
        other.add_shape(glass, shape, out["position_m"][k], orientation=out["orientation"][k], velocity=out["velocity_m_per_s"][k],
                        spin=out["spin_rad_per_s"][k], scale=np.cbrt(out["volume_m3"][k] / shape.volume))
    back = other.bodies()
    for name in ("mass_kg", "volume_m3", "inertia_kg_m2", "velocity_m_per_s", "spin_rad_per_s", "position_m"):
        assert back[name] == pytest.approx(out[name], abs=1e-12 * np.abs(out[name]).max()), name
    assert np.abs((back["orientation"] * out["orientation"]).sum(1)) == pytest.approx(1, abs=1e-12)
    assert other.position == pytest.approx(scene.position, abs=1e-12 * 0.015)
    assert other.velocity == pytest.approx(scene.velocity, abs=1e-12 * np.abs(scene.velocity).max() + 1e-15)
