"""What runs have written is read as the arrays of a scene are."""
import numpy as np
import pytest

import pendular
from conftest import tower

h5py = pytest.importorskip("h5py")


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
