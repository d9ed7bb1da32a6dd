"""Bonds, temperatures, two dimensions, mixtures, softness, sintering: each against a closed form."""
import numpy as np
import pytest

import pendular
from conftest import glass_in, tower


def bonded_pair(**material):
    """A grain that is held and one that is free, with a gap between them, joined along x."""
    scene = pendular.Scene()
    glass = glass_in(scene)
    scene.add_grains(glass, [[0, 0, 0]], 1e-3, fixed=True)
    scene.add_grains(glass, [[2.2e-3, 0, 0]], 1e-3)
    cement = scene.add_bond_material(radius=5e-4, **material)
    scene.bond([0], [1], cement)
    scene.time_step = 2e-7
    return scene


BEAM = dict(young_modulus=1e7, shear_modulus=4e6)
AREA, LENGTH = np.pi * 5e-4**2, 2.2e-3


@pytest.mark.parametrize("material, stiffness", [
    (BEAM, 1e7 * AREA / LENGTH), (dict(normal_stiffness=2e9, shear_stiffness=1e9), 2e9 * AREA),
    (dict(stiffness=lambda length: (1e6 * length, 1e3, 1e-3, 1e-3)), 1e6 * LENGTH)])
def test_a_bond_is_a_spring(material, stiffness):
    """A grain that is pushed off swings by v sqrt(m/k), and the bond has the force k times that."""
    scene = bonded_pair(**material)
    scene.set_velocity((1e-3, 0, 0), identities=[1])
    mass = scene.mass[1]
    omega = np.sqrt(stiffness / mass)
    scene.run(np.pi / 2 / omega)
    stretch = scene.position[1, 0] - LENGTH
    assert stretch == pytest.approx(1e-3 / omega, rel=1e-4)
    bonds = scene.bonds()
    assert bonds["length_m"] == pytest.approx([LENGTH]) and bonds["particle1"].tolist() == [0]
    assert bonds["force_N"] == pytest.approx(np.array([[-stiffness * stretch, 0, 0]]), rel=1e-3)


def test_a_bond_breaks_at_its_strength():
    """The largest tension is v sqrt(k m), so the stress that over the section."""
    largest = 1e-3 * np.sqrt(1e7 * AREA / LENGTH * 4 / 3 * np.pi * 1e-9 * 2500) / AREA
    for share, broken in ((1.01, 0), (0.99, 1)):
        scene = bonded_pair(**BEAM, tensile_strength=share * largest)
        scene.set_velocity((1e-3, 0, 0), identities=[1])
        scene.run(1e-3)
        assert scene.broken_bonds == broken and len(scene.bonds()["length_m"]) == 1 - broken


def warm_pair(**options):
    """Two grains that overlap, 100 K apart, for a time in which they move by nanometres."""
    scene = pendular.Scene()
    glass = glass_in(scene)
    scene.add_grains(glass, [[0, 0, 0], [1.99e-3, 0, 0]], 1e-3)
    scene.conduct_heat(300, **options)
    scene.set_heat_material(glass, conductivity=2000, heat_capacity=500)
    scene.temperature = [250, 350]
    scene.time_step = 1e-8
    return scene


@pytest.mark.parametrize("options, conductance", [
    ({}, 2 * 2000 * np.sqrt(0.5e-3 * 1e-5)), ({"softening": 1e-3}, 0.1 * 2 * 2000 * np.sqrt(0.5e-3 * 1e-5)),
    ({"law": "area_over_distance"}, 2000 * np.pi * 2 * 0.5e-3 * 1e-5 / 1.99e-3)])
def test_temperatures_approach_each_other(options, conductance):
    """The difference falls by the factor 1 - 2 H dt/C in each step, and no heat is lost."""
    scene = warm_pair(**options)
    scene.run(steps=200)
    capacity = 500 * scene.mass[0]
    cold, warm = scene.temperature
    fallen = -100 * np.expm1(200 * np.log1p(-2 * conductance * 1e-8 / capacity))
    assert 100 - (warm - cold) == pytest.approx(fallen, rel=2e-4)
    assert cold + warm == pytest.approx(600, rel=1e-13)
    assert scene.heat()["stored_J"] == pytest.approx(600 * capacity, rel=1e-13)


def test_a_wall_warms():
    """What comes from the wall is stored, and the grain gets no warmer than it."""
    scene = tower(count=1)
    scene.set_position((0, 0, 0.999e-3))
    scene.conduct_heat(300)
    scene.set_heat_material(scene.glass, conductivity=1, heat_capacity=800)
    scene.hold_temperature(scene.wall(0), 400)
    scene.run(0.05)
    heat = scene.heat()
    assert 300 < scene.temperature[0] < 400
    assert heat["from_walls_J"] == pytest.approx(800 * scene.mass[0] * (scene.temperature[0] - 300), rel=1e-10)
    assert heat["from_each_wall_J"] == {0: pytest.approx(heat["from_walls_J"], rel=1e-12)}


def test_softening_is_for_hertzs_contact_radius():
    """The overlap of a linear spring says nothing of the spot of real grains."""
    scene = pendular.Scene()
    stone = scene.add_species("LinearViscoelastic", density=2500, stiffness=1000)
    scene.add_grains(stone, [[0, 0, 0], [1.99e-3, 0, 0]], 1e-3)
    scene.conduct_heat(300, softening=0.01)
    scene.set_heat_material(stone, conductivity=1, heat_capacity=800)
    scene.time_step = 1e-8
    with pytest.raises(pendular.InputError, match="softening = 0.01 .* LinearViscoelastic, "):
        scene.run(steps=1)


def test_two_dimensions():
    """Discs of a density by area; their motion stays in the plane to the bit."""
    scene = pendular.Scene()
    stone = scene.add_species("LinearViscoelasticSlidingFriction", density=10, stiffness=300, dissipation=1e-3,
                              sliding_stiffness=80, sliding_friction_coefficient=0.4)
    scene.set_integrator("velocity_verlet")
    scene.hold_all()
    scene.set_grains_are_discs()
    scene.add_plane(stone, (0, -1, 0), (0, 0, 0))
    scene.add_grains(stone, [[0, 1e-3, 0], [0.5e-3, 2.95e-3, 0]], 1e-3)
    scene.gravity = (0, -9.81, 0)
    scene.choose_time_step()
    scene.run(0.02)
    assert scene.mass == pytest.approx([np.pi * 1e-6 * 10] * 2, rel=1e-14)
    assert not scene.position[:, 2].any() and not scene.velocity[:, 2].any() and not scene.spin[:, :2].any()
    assert scene.spin[:, 2].any()
    with pytest.raises(pendular.InputError, match="held"):
        scene.set_velocity((0, 0, 1))


def test_mixtures():
    """Two of three are of the one kind, exactly; an inlet brings both."""
    scene = pendular.Scene()
    glass, sand = glass_in(scene), glass_in(scene)
    mixture = pendular.Mixture()
    mixture.add(glass, pendular.one_size(1e-3), share=2)
    mixture.add(sand, pendular.one_size(2e-3))
    assert len(mixture) == 2
    made = scene.insert_mixture(mixture, pendular.box((0, 0, 0), (0.02, 0.02, 0.02)), number=60)
    assert made["number"] == 60
    assert np.bincount(scene.grain_species).tolist() == [40, 20]
    assert np.array_equal(scene.radius, np.where(scene.grain_species == 0, 0.5e-3, 1e-3))
    scene.add_mixture_inlet(mixture, pendular.box((0, 0, 0.03), (0.02, 0.02, 0.05)), number_flow=2e4)
    scene.choose_time_step()
    scene.run(0.002)
    assert np.unique(scene.grain_species[60:]).tolist() == [0, 1]


def test_mixtures_by_volume():
    scene = pendular.Scene()
    glass, sand = glass_in(scene), glass_in(scene)
    mixture = pendular.Mixture(by="volume")
    mixture.add(glass, pendular.one_size(1e-3), share=1)
    mixture.add(sand, pendular.one_size(2e-3), share=1)  # a grain of it has eight times the volume
    scene.insert_mixture(mixture, pendular.box((0, 0, 0), (0.02, 0.02, 0.02)), number=90)
    assert np.bincount(scene.grain_species).tolist() == [80, 10]


def test_the_softest_modulus():
    """Hertz' overlap under a pressure p is d/D = (3 pi (1 - nu^2) p / (2.8 E))^(2/3), and the solid fraction is 3.4 d/D off."""
    glass = dict(young_modulus=6e10, poisson_ratio=0.2, density=2500, diameter=1e-3)
    advice = pendular.softest_modulus(["solid_fraction"], **glass, pressure=1000, error=0.02)
    closed = 3 * np.pi * (1 - 0.2**2) * 1000 / 2.8 / (0.02 / 3.4) ** 1.5
    assert advice["young_modulus_Pa"] == pytest.approx(closed, rel=0.02)
    assert advice["bounds"][0][0] == advice["young_modulus_Pa"] and "solid-fraction" in advice["text"]
    scene = tower()
    scene.softest_modulus(["friction"], young_modulus=6e10, pressure=1000)
    with pytest.raises(pendular.InputError, match="solid_fraction"):
        scene.softest_modulus(["warmth"], young_modulus=6e10)


def rolling_tower(modulus, factor=1.0):
    """Grains with stiff springs of rolling and torsion, which limit the time step; a factor for their stiffness."""
    scene = pendular.Scene()
    sand = scene.add_species("HertzianViscoelasticMindlinRollingTorsion", density=2500, young_modulus=modulus, poisson_ratio=0.25,
                             restitution_coefficient=0.3, sliding_friction_coefficient=0.5, rolling_friction_coefficient=0.1,
                             torsion_friction_coefficient=0.1, rolling_stiffness=1e6 * factor, torsion_stiffness=1e6 * factor,
                             rolling_dissipation=factor**0.5, torsion_dissipation=factor**0.5)
    scene.add_plane(sand, (0, 0, -1), (0, 0, 0))
    scene.add_grains(sand, [[0, 0, 1.2e-3], [0, 0, 3.3e-3], [0, 0, 5.4e-3]], 1e-3)
    scene.gravity = (0, 0, -9.81)
    return scene


def test_the_gain_of_softness_is_that_of_the_scene():
    """As choose_time_step() has it: with springs of rolling that stay, the modulus alone gains nothing."""
    scene = rolling_tower(1e9)
    before = scene.choose_time_step()
    advice = scene.softest_modulus(["friction"], young_modulus=1e9, pressure=100)
    softer = advice["young_modulus_Pa"]
    assert softer < 1e8 and advice["step_s"] == before == scene.choose_time_step()
    assert advice["step_by_moduli_s"] == pytest.approx(rolling_tower(softer).choose_time_step()) == pytest.approx(before)
    assert advice["softer_step_s"] == pytest.approx(rolling_tower(softer, (softer / 1e9) ** (2 / 3)).choose_time_step())
    decades = 2 * np.log10(advice["softer_step_s"] / before)
    assert (advice["least_gain"], advice["most_gain"]) == pytest.approx((2.2**decades, 3.1**decades))
    factors = {name: factor for of, name, factor in advice["scale"] if of == (0, 0)}
    assert factors["effective_shear_modulus"] == pytest.approx(softer / 1e9)
    assert factors["rolling_stiffness"] == factors["torsion_stiffness"] == pytest.approx((softer / 1e9) ** (2 / 3))
    assert "rolling_stiffness x" in advice["text"]


def test_contacts_sinter():
    """The plastic overlap grows by 2 r F / S_a under the spring's force F = S_a D - c v, with D = 2 R* and the dashpot c, so
    the grains approach by v = 2 r D / (1 + 2 r c / S_a)."""
    scene = pendular.Scene()
    glass = scene.add_species("SinterMindlin", density=2500, loading_stiffness=1000, unloading_stiffness_max=5000,
                              cohesion_stiffness=0, penetration_depth_max=0.5, dissipation=0.05, sinter_adhesion=0.1,
                              sinter_rate=0.5, sinter_type=1, effective_shear_modulus=4e5,
                              sliding_dissipation=0,
                              sliding_friction_coefficient=0.4)
    scene.add_grains(glass, [[0, 0, 0], [1.9999e-3, 0, 0]], 1e-3)
    scene.time_step = 0.5 * scene.stability_limit()
    scene.run(0.02)
    start = scene.position[1, 0] - scene.position[0, 0]
    scene.run(0.06)
    grown = start - (scene.position[1, 0] - scene.position[0, 0])
    assert grown == pytest.approx(0.04 * 2 * 0.5 * 1e-3 / (1 + 2 * 0.5 * 0.05 / 0.1), rel=2e-3)


# What is done, and words of the sentence.
MISUSES = {
    "bonds that are not there": (lambda s: s.bonds(), "add_bond_material"),
    "no stiffness": (lambda s: s.add_bond_material(5e-4), "young_modulus"),
    "two stiffnesses": (lambda s: s.add_bond_material(5e-4, **BEAM, normal_stiffness=1, shear_stiffness=1), "young_modulus"),
    "negative modulus": (lambda s: s.add_bond_material(5e-4, young_modulus=-1, shear_modulus=1), "young_modulus"),
    "no strength": (lambda s: s.add_bond_material(5e-4, **BEAM, tensile_strength=0), "strength"),
    "bond of one that is not there": (lambda s: s.bond([0], [9], s.add_bond_material(5e-4, **BEAM)), "9"),
    "as many as": (lambda s: s.bond([0], [1, 2], s.add_bond_material(5e-4, **BEAM)), "1 and 2 identities"),
    "no such material": (lambda s: (s.add_bond_material(5e-4, **BEAM), s.bond([0], [1], 3)), "material 3"),
    "bonded twice": (lambda s: (s.bond([0, 1], [1, 0], s.add_bond_material(5e-4, **BEAM)), s.run(steps=1)), "0 and 1|1 and 0"),
    "a stiffness that is none": (
        lambda s: (s.bond([0], [1], s.add_bond_material(5e-4, stiffness=lambda length: 1)), s.run(steps=1)), "four numbers"),
    "heat that is not there": (lambda s: s.heat(), "conduct_heat"),
    "heat twice": (lambda s: (s.conduct_heat(), s.conduct_heat()), "before"),
    "below zero": (lambda s: s.conduct_heat(-1), "temperature"),
    "no such law of heat": (lambda s: s.conduct_heat(law="air"), "constriction"),
    "no material": (lambda s: (s.conduct_heat(), s.run(steps=1)), r"set_heat_material\(\)"),
    "parts in a run": (lambda s: (s.run(steps=1), s.add_bond_material(5e-4, **BEAM)), "before the run|set-up|begun"),
    "held all in a run": (lambda s: (s.run(steps=1), s.hold_all()), "set-up|before"),
    "an empty mixture": (lambda s: s.insert_mixture(pendular.Mixture(), pendular.sphere((0, 0, 1), 1), number=1), "empty"),
    "a mixture by length": (lambda s: pendular.Mixture(by="length"), "length"),
    "no figures": (lambda s: s.softest_modulus([], young_modulus=1e9), "figure"),
    "no such cohesion": (lambda s: s.softest_modulus(["friction"], young_modulus=1e9, pull=1, kept="all"), "strength"),
}


@pytest.mark.parametrize("do, words", MISUSES.values(), ids=MISUSES.keys())
def test_misuse(do, words):
    with pytest.raises(pendular.InputError, match=words) as caught:
        do(tower())
    sentence = str(caught.value)
    assert "\n" not in sentence and sentence.endswith(".") and len(sentence) > 20, sentence
