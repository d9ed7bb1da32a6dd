"""The Python of the READMEs runs as it is; the tower of the first one has the bits of the driver beside it."""
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pendular

ROOT = Path(__file__).parents[2]
DRIVER = os.environ.get("PENDULAR_WET_TOWER")


def code_of(page):
    text = (ROOT / page).read_text()
    if page.endswith(".py"):
        return re.search(r"\n((?:    .*\n)+)", text)[1].replace("\n    ", "\n")[4:]
    return re.search(r"```python\n(.*?)```", text, flags=re.S)[1]


@pytest.mark.parametrize("page", ["README.md", "Tools/Python/README.md", "Tools/Python/Package/__init__.py"])
def test_page(page):
    names = {}
    exec(compile(code_of(page), page, "exec"), names)
    assert names["scene"].steps > 0


@pytest.mark.skipif(not DRIVER, reason="PENDULAR_WET_TOWER is not the program WetTower")
def test_tower_is_the_same_in_both_languages(capsys):
    """The same lines at the same times, and the same bits of all particles at the end."""
    driver = subprocess.run([DRIVER, "--output", "tower", "--hdf5-interval-s", "1"], capture_output=True, text=True)
    assert driver.returncode == 0, driver.stderr
    names = {}
    exec(compile(code_of("README.md"), "README.md", "exec"), names)
    scene = names["scene"]
    first, *between, last = driver.stdout.splitlines()  # C++ prints at the start and at the end, too
    assert capsys.readouterr().out.splitlines() == between and len(between) > 3
    assert last == f"{scene.time:.3f} s, top at {scene.position[:, 2].max()} m" and first.startswith("0.000 s")
    (*_, (time, of_driver)), own = pendular.frames("tower/run-fields.h5"), scene.grains()
    assert time == scene.time
    assert of_driver["position_m"].dtype == float
    for name in ("position_m", "velocity_m_per_s", "spin_rad_per_s"):  # the files have some of them as float32
        assert (of_driver[name] == np.asarray(own[name], of_driver[name].dtype)).all(), name
