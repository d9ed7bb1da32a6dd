"""The page's JavaScript, without a browser and without npm: its syntax, and that each name that a file takes from another
one is given there."""
import pathlib
import re
import shutil
import subprocess

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "Tools/View/Page/src"
FILES = sorted(SOURCE.rglob("*.js"))


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_all_files_can_be_read():
    for file in FILES:
        done = subprocess.run(["node", "--input-type=module", "--check"], input=file.read_text(), capture_output=True, text=True)
        assert done.returncode == 0, (file, done.stderr)


def test_what_is_taken_is_given():
    assert len(FILES) > 10
    for file in FILES:
        for names, other in re.findall(r'import \{([^}]*)\} from "(\.[^"]*)"', file.read_text()):
            given = set(re.findall(r"export (?:async )?(?:function|const|class) (\w+)", (file.parent / other).read_text()))
            assert {name.strip() for name in names.split(",")} <= given, (file, other)


