"""The Python of the READMEs runs as it is."""
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("page", ["README.md", "Tools/Python/README.md", "Tools/Python/Package/__init__.py"])
def test_page(page):
    text = (ROOT / page).read_text()
    if page.endswith(".py"):
        code = re.search(r"\n((?:    .*\n)+)", text)[1].replace("\n    ", "\n")[4:]
    else:
        code = re.search(r"```python\n(.*?)```", text, flags=re.S)[1]
    names = {}
    exec(compile(code, page, "exec"), names)
    assert names["scene"].steps > 0
