"""What runs have written is read as the arrays of a scene are."""
import os
import sys
import types

import numpy as np
import pytest

import pendular
from conftest import tower


def test_frames_are_those_of_the_scene():
    scene, seen = tower("run"), {}
    scene.write_hdf5(1e-3, doubles=True, stress=True)
    scene.every_time(1e-3, lambda s: seen.update({s.steps: (s.time, s.grains(stress=True), s.contacts())}))
    scene.run(5e-3)
    scene.finish()
    grains = {time: columns for time, columns in pendular.frames("run-fields.h5")}
    contacts = {time: columns for time, columns in pendular.frames("run-fields.h5", part="contacts")}
    assert len(seen) == 5
    for time, of_scene, its_contacts in seen.values():
        assert set(of_scene) == set(grains[time])
        for name, values in of_scene.items():
            assert np.array_equal(values, grains[time][name]), name
        for name in ("particle1", "particle2", "wall", "force_N", "overlap_m"):
            assert np.array_equal(its_contacts[name], contacts[time][name]), name


def test_fields_of_functions_where_all_grains_are_new():
    """Those of a frame are of its own grains, where they are others than those of the frame before, more, fewer or none."""
    scene = tower("run")
    scene.write_hdf5(1e-3, doubles=True, fields={"height_m": lambda s: s.position[:, 2]},
                     vectors={"place_m": lambda s: s.position})

    def renew(scene):
        count = {1: 7, 2: 0, 3: 2}.get(round(scene.time / 1e-3), len(scene))
        if count != len(scene):
            scene.remove_grains(scene.identity)
            if count:
                scene.add_grains(scene.glass, [[0.01 * k, 0.02, 0.1 + 0.01 * k] for k in range(count)], 1e-3)

    scene.every_time(1e-3, renew)
    scene.run(5e-3)
    scene.finish()
    frames = [columns for _, columns in pendular.frames("run-fields.h5")]
    assert {len(columns["position_m"]) for columns in frames} == {4, 7, 0, 2}
    for columns in frames:
        assert np.array_equal(columns["height_m"], columns["position_m"][:, 2])
        assert np.array_equal(columns["place_m"], columns["position_m"])


def test_a_part_that_is_not_there():
    scene = tower("run")
    scene.write_hdf5(1e-3, contacts=False)
    scene.run(1e-3)
    scene.finish()
    with pytest.raises(pendular.InputError, match="has no contacts; it has .*particles"):
        list(pendular.frames("run-fields.h5", part="contacts"))


def test_tables_have_units():
    pandas = pytest.importorskip("pandas")
    scene = tower("run")
    scene.write_energy(1e-3)
    scene.run(3e-3)
    scene.finish()
    table = pendular.table("run-energy.csv")
    assert isinstance(table, pandas.DataFrame)
    assert table["kinetic_J"].iloc[-1] == pytest.approx(scene.energy()["kinetic_J"], rel=1e-6)


def test_restart_file_as_tables():
    scene = tower("run")
    scene.run(steps=3)
    scene.write_restart("state.h5")
    tables = pendular.restart("state.h5")
    assert np.array_equal(tables["particles/translation"][:, :3], scene.position)
    assert tables["steps"].item() == 3


def test_damaged_files_are_refused():
    """The HDF5 library crashes on some of them, and would take the interpreter with it: it reads in a process of its own."""
    scene = tower("run")
    scene.write_hdf5(1e-3)
    scene.run(2e-3)
    scene.finish()
    scene.write_restart("state.h5")
    for name, read in (("state.h5", pendular.restart), ("run-fields.h5", lambda f: list(pendular.frames(f)))):
        with open(name, "rb") as file:
            good = file.read()
        assert read(name)
        for bad in (b"", good[:700], good.replace(b"TREE", b"tree"), good.replace(b"SNOD", b"snod")):
            with open(name, "wb") as file:
                file.write(bad)
            with pytest.raises(pendular.InputError, match=name) as caught:
                read(name)
            assert "\n" not in str(caught.value)
        with open(name, "wb") as file:
            file.write(good)
    with pytest.raises(pendular.InputError, match="state.h5 is no list of frames"):
        list(pendular.frames("state.h5"))
    frame = sorted(name for name in os.listdir(".") if name.startswith("run-fields-"))[0]
    os.remove(frame)
    with pytest.raises(pendular.InputError, match=f"There is no file {frame}"):
        list(pendular.frames("run-fields.h5"))


def test_picture():
    pytest.importorskip("matplotlib")
    scene = tower()
    axes = pendular.draw(scene, color="velocity_m_per_s")
    discs = axes.collections[0]
    assert len(discs.get_offsets()) == 4
    assert sorted(np.asarray(discs.get_offsets())[:, 1]) == pytest.approx(sorted(scene.position[:, 2]))
    pendular.draw(scene, color=np.arange(4), axes=axes)
    with pytest.raises(pendular.InputError, match="each of 4 grains"):
        pendular.draw(scene, color=[1, 2])


def test_points_of_pyvista(monkeypatch):
    """What its PolyData is given, by a stand-in: points N x 3, and an array of N rows for each column."""
    class PolyData(dict):
        def __init__(self, points):
            super().__init__(points=points)

    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(PolyData=PolyData))
    scene = tower()
    points, columns = pendular.to_pyvista(scene), scene.grains()
    assert np.array_equal(points["points"], scene.position)
    assert np.array_equal(points["diameter_m"], 2 * scene.radius)
    for name in set(columns) - {"position_m"}:
        assert points[name].ndim <= 2 and np.array_equal(points[name].ravel(), columns[name].ravel()), name


def test_files_do_not_depend_on_the_threads(tmp_path):
    """Contacts of grains, of images across the faces of the period, and of walls; with a column of the driver."""
    from conftest import glass_in

    def files(threads):
        scene = pendular.Scene(str(tmp_path / f"run-{threads}"), threads=threads)
        glass = glass_in(scene)
        scene.set_periodic("x", 0, 8e-3)
        scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
        k = np.arange(64)
        scene.add_grains(glass, 1.99e-3 * np.stack([k % 4, k // 4 % 4, k // 16 + 0.502], 1), 1e-3)
        scene.add_contact_column("age", "s", initial=1)
        scene.gravity = (0, 0, -9.81)
        scene.choose_time_step()
        scene.write_paraview(1, doubles=True)
        scene.run(steps=20)
        scene.finish()
        contacts = scene.contacts()
        assert (contacts["wall"] == 0).any() and (contacts["wall"] == -1).sum() > 64
        names = sorted(p.name.replace(f"run-{threads}", "run") for p in tmp_path.glob(f"run-{threads}-*.vtp"))
        return names, [p.read_bytes() for p in sorted(tmp_path.glob(f"run-{threads}-*.vtp"))], contacts

    one, three = files(1), files(3)
    assert one[0] == three[0] and len(one[0]) >= 6
    assert one[1] == three[1]
    for name, values in one[2].items():
        assert np.array_equal(values, three[2][name]), name
