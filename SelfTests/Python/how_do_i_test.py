"""Each snippet of Tools/Python/HOW-DO-I.md runs after the first one; each question of the page for C++ has an answer."""
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "Tools/Python/HOW-DO-I.md").read_text()


def sections():
    for part in re.split(r"^### ", PAGE, flags=re.M)[1:]:
        title, _, text = part.partition("\n")
        for number, code in enumerate(re.findall(r"```python\n(.*?)```", text, flags=re.S)):
            yield pytest.param(code, id=f"{title.replace(' ', '_')}{number or ''}")


FIRST = re.search(r"```python\n(.*?)```", PAGE, flags=re.S)[1]


@pytest.mark.parametrize("code", sections())
def test_snippet(code):
    """It runs, and so does its scene behind it."""
    names = {}
    exec(compile(FIRST, "the first snippet", "exec"), names)
    exec(compile(code, "the snippet", "exec"), names)
    scene = names["scene"]
    if not scene.has_ended:
        scene.run(steps=5)
        assert scene.steps >= 5


def test_heights_of_rebound():
    """e^2 h, of the spheres that run_many() lets fall from h = 1 mm. The height is seen every 100 steps, and the wall yields."""
    names = {}
    code = next(part for part in re.findall(r"```python\n(.*?)```", PAGE, flags=re.S) if "run_many(" in part)
    exec(compile(f"import pendular\n{code}", "the snippet", "exec"), names)
    assert names["heights"] == pytest.approx([1e-3 * e**2 for e in (0.5, 0.7, 0.9)], rel=0.02)


def test_same_questions_as_for_cpp():
    titles = set(re.findall(r"^### (.*)$", PAGE, flags=re.M))
    cpp = set(re.findall(r"^### (.*)$", (ROOT / "Kernel/HOW-DO-I.md").read_text(), flags=re.M))
    assert not cpp - titles
