"""What a user meets: names that are completed, texts of objects, copies, handles, lists of parts, arrays of all grains."""
import copy
import pickle
import re
import threading

import numpy as np
import pytest

import pendular
from conftest import glass_in, tower


def test_names_of_the_package():
    names = dir(pendular)
    assert "Scene" in names and "draw" in names and not [n for n in names if n.startswith("_") and not n.startswith("__")]
    assert len(set(pendular.__all__)) == len(pendular.__all__) and all(hasattr(pendular, n) for n in pendular.__all__)
    assert re.fullmatch(r"\d+\.\d+\.\d+", pendular.__version__)


OBJECTS = {
    "scene": (lambda s: s, r"<pendular.Scene 'pendular': 4 grains, 0 s>", r"write_restart\(\)"),
    "species": (lambda s: s.glass, r"<pendular.Species 0: HertzianViscoelasticMindlin, 2500 kg/m\^3>", "hand its numbers on"),
    "wall": (lambda s: s.wall(0), "<pendular.Wall 0: plane>", "hand its number on"),
    "region": (lambda s: pendular.box((0, 0, 0), (1, 1, 1)), "<pendular.Region: box>", "from its numbers"),
    "sizes": (lambda s: pendular.even_sizes(1e-3, 3e-3), "<pendular.Sizes: 0.001 to 0.003 m, mean 0.002 m>", "from its numbers"),
    "shape": (lambda s: pendular.clump([[0, 0, 0, 1]]), "<pendular.Shape: clump>", "from its numbers"),
    "mixture": (lambda s: pendular.Mixture(), "<pendular.Mixture: 0 kinds>", "from its numbers"),
}


@pytest.mark.parametrize("make, text, advice", OBJECTS.values(), ids=OBJECTS.keys())
def test_objects_have_texts_and_refuse_copies(make, text, advice):
    one = make(tower())
    assert re.fullmatch(text, repr(one))
    for take in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match=r"A \w+ cannot be copied or pickled; .*" + advice):
            take(one)


@pytest.mark.parametrize("wrong, right", [("timestep", "time_step"), ("gravitiy", "gravity"), ("endtime", "end_time"),
                                          ("positions", "position"), ("velocities", "velocity"), ("radii", "radius"),
                                          ("dt", "time_step"), ("max_time", "end_time"), ("number_of_threads", "threads"),
                                          ("g", "gravity"), ("film_volume", "film")])
def test_an_attribute_that_is_nearly_one_of_the_scene(wrong, right):
    """It would be set, and do nothing."""
    scene = tower()
    with pytest.raises(AttributeError, match=f"no attribute {wrong}; did you mean {right}"):
        setattr(scene, wrong, 1)
    scene.mine, scene.glasses = 1, 2
    scene.mine += 1
    assert scene.mine == 2
    with pytest.raises(AttributeError):
        scene.walls[0].velocity = (0, 0, 1)
    with pytest.raises(AttributeError):
        scene.time = 3


@pytest.mark.parametrize("name, words", [
    ("walls", "walls can be read, but not assigned"), ("steps", "steps can be read, but not assigned"),
    ("inlet", r"inlet\(\) is a method and cannot be assigned"), ("run", r"run\(\) is a method"),
    ("inlets", r"no attribute inlets; its inlet\(\) is a method and cannot be assigned"),
    ("wals", "no attribute wals; its walls can be read, but not assigned")])
def test_what_cannot_be_assigned(name, words):
    scene = tower()
    with pytest.raises(AttributeError, match=words) as caught:
        setattr(scene, name, [])
    assert str(caught.value).endswith(".") and str(caught.value).count(". ") == 0
    scene.run(steps=1)


def test_attributes_of_a_class_of_your_own():
    """They are its own, also where the scene has a method of the name."""
    class Drum(pendular.Scene):
        speed = 1

        def run(self):
            return "mine"

        @property
        def turns(self):
            return 2 * self.speed

    drum = Drum()
    drum.speed, drum.run = 3, lambda: "other"
    assert drum.turns == 6 and drum.run() == "other"
    with pytest.raises(AttributeError, match="turns can be read"):
        drum.turns = 1


def test_walls_and_species_of_a_scene():
    scene = tower()
    steel = scene.add_species("HertzianViscoelasticMindlin", density=7800, young_modulus=1e7, poisson_ratio=0.3,
                              restitution_coefficient=0.7)
    assert scene.species == [scene.glass, steel] and [s.index for s in scene.species] == [0, 1]
    made = [scene.add_cylinder(steel, (0, 0, 1), (0, 0, 0), 1), scene.add_cylinder(steel, (0, 0, 1), (0, 0, 0), 1, length=1),
            scene.add_profile(steel, (0, 0, 1), (0, 0, 9), [(1, 0), (2, 1)]),
            scene.add_mesh(steel, [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]])]
    assert [w.kind for w in scene.walls] == ["plane", "cylinder", "tube", "profile", "mesh"]
    assert scene.walls[1:] == made and scene.wall(2) == made[1] != made[0]
    scene.remove_wall(made[0])
    assert scene.walls[1:] == made[1:] and made[0].kind == "removed"
    assert len({scene.wall(0), scene.walls[0]}) == 1 and scene.wall(0) != tower().wall(0) and scene.wall(0) != 0


def resting():
    """A grain of some spin that presses on a floor, and one that is held beside it and touches it."""
    scene = pendular.Scene()
    glass = glass_in(scene)
    scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
    scene.add_grains(glass, [[0, 0, 0.999e-3]], 1e-3, spin=(0, 10, 0))
    scene.add_grains(glass, [[1.99e-3, 0, 1.1e-3]], 1e-3, fixed=True)
    scene.add_grains(glass, [[0, 5e-3, 9e-3]], 1e-3, held="x about_z")
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    scene.run(steps=5)
    return scene


def test_forces_of_contacts():
    """On a free grain the force without its weight; on the held one that of the contact alone."""
    scene = resting()
    contacts, force = scene.contacts(), scene.contact_force
    weight = np.array([0, 0, -9.81 * scene.mass[0]])
    assert force[0] + weight == pytest.approx(scene.force[0], rel=1e-9)
    between = contacts["wall"] < 0
    assert force[1] == pytest.approx(-contacts["force_N"][between][0], rel=1e-14) and np.linalg.norm(force[1]) > 0
    assert scene.force[1] == pytest.approx(force[1], rel=1e-14)


def test_torques():
    """(point of contact - centre) x force, of both contacts."""
    scene = resting()
    contacts = scene.contacts_of(0)
    # The arm of contacts is the radius less half the overlap; that of the law may be the whole radius.
    torque = np.cross(contacts["contact_point_m"] - scene.position[0], contacts["force_N"]).sum(0)
    assert scene.torque[0] == pytest.approx(torque, rel=2e-3, abs=1e-3 * np.linalg.norm(torque))
    assert np.linalg.norm(torque) > 0
    # Grains of one radius have one arm at their contact, so that it gives both one torque, held or not.
    pair = contacts["wall"] < 0
    shared = np.cross((contacts["contact_point_m"] - scene.position[0])[pair], contacts["force_N"][pair]).sum(0)
    assert scene.torque[1] == pytest.approx(shared, rel=2e-3, abs=1e-3 * np.linalg.norm(torque))
    assert np.linalg.norm(scene.torque[1]) > 0


def test_contacts_of_one_grain():
    scene = resting()
    all_of_them, own = scene.contacts(), scene.contacts_of(0)
    assert len(own["wall"]) == 2 and len(scene.contacts_of(2)["wall"]) == 0
    order = np.argsort(own["wall"], kind="stable")
    of_all = np.argsort(all_of_them["wall"], kind="stable")
    for name in set(own) & set(all_of_them):
        assert np.array_equal(own[name][order], all_of_them[name][of_all]), name
    assert {"particle1", "particle2", "wall", "force_N", "overlap_m", "contact_point_m"} <= set(own) & set(all_of_them)
    with pytest.raises(pendular.InputError, match="9"):
        scene.contacts_of(9)


def test_held_axes():
    scene = resting()
    assert scene.held.tolist() == [[False] * 6, [True] * 6, [True, False, False, False, False, True]]
    scene.hold([2], "")
    assert not scene.held[2].any()


def test_fields_of_functions():
    """Each frame has what the function gives at its time, row by row, also where grains come and go."""
    scene, seen = tower("run"), []

    def height(s):
        return s.position[:, 2]

    def spot(s):
        seen.append((s.time, s.position))
        return s.position

    scene.write_hdf5(1e-3, doubles=True, fields={"height_m": height}, vectors={"spot_m": spot})
    scene.run(2e-3)
    scene.remove_grains([1])
    scene.add_grains(scene.glass, [[0, 0, 0.1]], 1e-3)
    scene.run(4e-3)
    scene.finish()
    frames = dict(pendular.frames("run-fields.h5"))
    assert len(frames) >= 5 and len(seen) == len(frames)
    for time, position in seen:
        assert np.array_equal(frames[time]["spot_m"], position) and np.array_equal(frames[time]["height_m"], position[:, 2])
        assert np.array_equal(frames[time]["position_m"], position)


@pytest.mark.parametrize("options", [{"fields": {"a_m": lambda s: [1, 2]}}, {"vectors": {"a_m": lambda s: s.radius}},
                                     {"fields": {"a_m": lambda s: "text"}}])
def test_fields_of_other_shapes(options):
    scene = tower("run")
    with pytest.raises((pendular.InputError, pendular.RunError), match="field a_m must return .* each of 4 grains"):
        scene.write_hdf5(1e-3, **options)
        scene.run(1e-3)


def test_where_the_time_goes():
    scene = tower()
    scene.measure_step_times()
    scene.run(steps=2000)
    times = scene.step_times()
    assert {"motion_s", "contacts_s", "energy_ledger_s"} <= set(times) and all(t >= 0 for t in times.values())
    assert times["motion_s"] > 0 and times["energy_ledger_s"] == 0


def test_a_scene_that_another_thread_runs_has_a_text():
    scene, began = tower(), threading.Event()
    scene.every_steps(1, lambda s: began.set())

    def run():
        with pytest.raises(pendular.RunStopped):
            scene.run(1e9)

    runs = threading.Thread(target=run)
    runs.start()
    began.wait()
    texts = {repr(scene) for _ in range(1000)}
    scene.stop()
    runs.join()
    assert texts <= {"<pendular.Scene, in which another thread is at work>", repr(scene)} | {t for t in texts if " 4 grains" in t}


def test_walls_as_polygons():
    """A box of planes is cut off at its edges: six squares with the corners of the box."""
    scene = pendular.Scene()
    glass = glass_in(scene)
    scene.add_box(glass, (0, 0, 0), (0.01, 0.01, 0.01))
    scene.add_grains(glass, [[5e-3, 5e-3, 5e-3]], 1e-3)
    made = scene.wall_polygons()
    assert made["wall"].tolist() == list(range(6)) and made["ends"].tolist() == list(range(4, 25, 4))
    corners = np.unique(np.round(made["points_m"], 9), axis=0)
    assert corners.tolist() == [[x, y, z] for x in (0, 0.01) for y in (0, 0.01) for z in (0, 0.01)]
    assert len(pendular.Scene().wall_polygons()["ends"]) == 0


def test_walls_are_drawn():
    pytest.importorskip("matplotlib")
    from matplotlib.collections import PolyCollection

    def drawn(axes):
        return [len(c.get_paths()) for c in axes.collections if isinstance(c, PolyCollection)]

    assert drawn(pendular.draw(tower())) == [1] and drawn(pendular.draw(tower(), walls=False)) == []
    # The axes show all of the floor, which is wider than the tower.
    scene = tower()
    floor = scene.wall_polygons()["points_m"][:, 0]
    assert floor.max() > scene.position[:, 0].max() + 1e-3
    assert pendular.draw(scene).get_xlim() == pytest.approx((floor.min(), floor.max()), rel=1e-12)
    # Pictures of a run have one box: the floor is as wide when the tower has fallen by 0.24 mm.
    height = scene.position[:, 2].max()
    scene.run(0.007)
    assert scene.position[:, 2].max() < height - 2e-4 and np.array_equal(scene.wall_polygons()["points_m"][:, 0], floor)
    assert drawn(pendular.draw(pendular.Scene())) == [0] == drawn(pendular.draw(pendular.Scene(), color="velocity_m_per_s"))
    with pytest.raises(TypeError, match="must be a Scene"):
        pendular.draw("x")


def test_settings_are_read_again():
    scene = tower()
    scene.set_domain((0, 0, 0), (1, 2, 3))
    assert [c.tolist() for c in scene.domain] == [[0, 0, 0], [1, 2, 3]]
    scene.set_integrator("velocity_verlet")
    assert scene.integrator == "velocity_verlet"
    with pytest.raises(pendular.InputError, match="domain|setMin|set_domain"):
        tower().domain


def test_the_step_for_a_figure():
    """The kernel's tests have its length; here the figure's name, and what is returned."""
    scene = tower()
    usual = scene.choose_time_step()
    said = scene.set_step_for(0.05, figure="solid_fraction")
    assert "for solid_fraction to 0.05" in said and scene.time_step > usual
    assert scene.set_step_for(0.05, figure="solid-fraction") == said
    with pytest.raises(pendular.InputError) as unknown:
        scene.set_step_for(0.05, figure="angles")
    assert str(unknown.value) == ('set_step_for(): no figure is called "angles"; there are solid_fraction, friction, contacts_at_rest, '
                                  "contacts_in_flow, fluctuations.")
    with pytest.raises(pendular.InputError, match=r"^set_step_for\(\): contact_time follows single collisions"):
        scene.set_step_for(0.05, figure="contact_time")
    with pytest.raises(pendular.InputError, match=r"^softest_modulus\(\): .* solid_fraction, .* contact_time"):
        scene.softest_modulus(["angles"], young_modulus=6e10)


def test_the_adaptive_step_tells_what_it_chose():
    scene = tower()
    scene.time_step = scene.stability_limit()
    scene.set_adaptive_time_step(0.9)
    scene.run(0.01)
    chosen = scene.adaptive_time_step()
    assert chosen["choices"] > 1 and 0 < chosen["smallest_s"] <= scene.time_step <= chosen["largest_s"]


def test_progress_of_steps(capsys):
    tower().run(steps=50, progress=True)
    assert capsys.readouterr().err.strip()


def test_a_region_from_triangles():
    """The inside of a tetrahedron has a sixth of the product of its edges."""
    o, x, y, z = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)
    inside = pendular.mesh_inside([[o, y, x], [o, x, z], [o, z, y], [x, y, z]], scale=0.1)
    assert inside.volume == pytest.approx(1e-3 / 6, rel=1e-12)
    assert inside.contains((0.01, 0.01, 0.01)) and not inside.contains((0.09, 0.09, 0.09))


def test_triangles_of_a_mesh():
    """A square plate of two triangles, and a corner: what is drawn and computed from the arrays is the wall, also where it moved."""
    scene = pendular.Scene(quiet=True)
    glass = glass_in(scene)
    plate = scene.add_mesh(glass, [[[0, 0, 0], [2, 0, 0], [2, 1, 0]], [[0, 0, 0], [2, 1, 0], [0, 1, 0]],
                                   [[0, 0, 0], [0, 1, 0], [0, 0, 3]]])
    def area():
        corners = plate.vertices[plate.triangles]
        return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2

    assert plate.triangles.shape[1] == 3 and plate.triangles.max() == len(plate.vertices) - 1
    assert area() == pytest.approx(2 + 1.5, rel=1e-12)  # of the square of 2 x 1, and half of 1 x 3
    assert len(plate.vertices) == 5  # corners that triangles share are one
    plane = scene.add_plane(glass, (0, 0, -1), (0, 0, -9))
    for name in ("triangles", "vertices"):
        with pytest.raises(pendular.InputError, match=f"Wall 1 has no {name}"):
            getattr(plane, name)
