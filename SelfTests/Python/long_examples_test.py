"""Examples that take minutes, against what is known of their results."""
import re

import numpy as np
import pytest

from examples_test import run  # which also finds the examples

pytest.importorskip("matplotlib")


def test_pressure_of_the_shear_is_its_target():
    from wet_shear import PRESSURE, make_shear, shear

    strain, pressure, friction, bridges = shear(make_shear(), 4.0)
    late = strain > 1.5
    assert pressure[late].mean() == pytest.approx(PRESSURE, rel=0.05)
    assert 0.2 < friction[late].mean() < 1.5 and bridges[late].mean() > 1


def test_drum():
    """The slopes of a bed that turns are between the angle of friction's half and twice that, and agree as far as its surface,
    seven grains wide, is plane."""
    from drum import make_drum, slope

    scene, slopes = make_drum(), []
    scene.every_time(0.02, lambda s: slopes.append(slope(s)))
    scene.run(0.5)
    centre, surface = np.mean(slopes[-8:], 0)
    assert 13 < centre < 53 and abs(surface - centre) < 10


def test_study_goes_on_two_processes(tmp_path):
    pandas = pytest.importorskip("pandas")
    run("study.py", "--output", tmp_path)
    table = pandas.read_csv(tmp_path / "study.csv")
    assert (table["spread_m"].iloc[0] > table["spread_m"].iloc[2:]).all()  # without friction it runs away


def test_calibration_meets_the_measurements():
    """To twice what two heaps of other seeds differ by (0.7 degrees, 0.4 mm); it begins three times as far away."""
    pytest.importorskip("scipy")
    from calibration import calibrate, heap

    def mean(*numbers):
        return np.array([heap(*numbers, seed=seed) for seed in (1, 2)]).mean(0)

    wanted = mean(0.6, 0.2)
    assert mean(0.3, 0.05)[0] < wanted[0] - 4
    angle, width = mean(*calibrate(*wanted))
    assert abs(angle - wanted[0]) < 1.5 and abs(width - wanted[1]) < 8e-4


def notebook(name, folder, monkeypatch, *options):
    """What the notebook of an example prints, and whether it shows a picture."""
    pytest.importorskip("nbclient")
    from notebooks_test import made, run as run_notebook

    return run_notebook(*made(folder, name), monkeypatch, options)


def numbers_of(text):
    return [float(number) for number in re.findall(r"\d+\.\d+", text)]


def test_notebook_of_the_hopper_flows_as_beverloo_says(tmp_path, monkeypatch):
    text, hasPicture = notebook("hopper.py", tmp_path, monkeypatch)
    flow, expected = numbers_of(text)  # g/s
    assert flow == pytest.approx(expected, rel=0.1) and hasPicture


def test_notebook_of_the_calibration_meets_the_measurements(tmp_path, monkeypatch):
    """To three times what heaps of other seeds differ by, as it shows one heap."""
    text, _ = notebook("calibration.py", tmp_path, monkeypatch)
    friction, rolling, angle, width = numbers_of(text)
    assert abs(angle - 12) < 2.1 and abs(width - 11) < 1.2  # degrees, mm
    assert 0.05 <= friction <= 1 and 0.05 < rolling <= 0.5


@pytest.mark.parametrize("name, options", [("drum.py", ("--time", "0.1")), ("wet_shear.py", ("--strain", "0.5")),
                                           ("restart.py", ()), ("study.py", ())])
def test_notebook(tmp_path, monkeypatch, name, options):
    assert notebook(name, tmp_path, monkeypatch, *options)[0]
