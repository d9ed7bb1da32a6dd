"""The notebooks of the examples run as they are made. Those that take longer are in long_examples_test.py."""
import json
import subprocess
import sys
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")
PYTHON = Path(__file__).parents[2] / "Tools/Python"


def made(folder, *names):
    scripts = [PYTHON / "Examples" / name for name in names]
    subprocess.run([sys.executable, PYTHON / "make-notebooks.py", folder, *scripts], check=True)
    return sorted(folder.glob("*.ipynb"))


def run(file, monkeypatch, options=()):
    """All cells, the last one with these options; returns what they have shown: text, and whether there is a picture."""
    kernel = file.parent / "jupyter/kernels/own"  # this interpreter, whatever `python3` is
    kernel.mkdir(parents=True)
    (kernel / "kernel.json").write_text(json.dumps({
        "argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"], "display_name": "own",
        "language": "python"}))
    monkeypatch.setenv("JUPYTER_PATH", str(file.parent / "jupyter"))
    monkeypatch.delenv("MPLBACKEND", raising=False)  # pictures come into the notebook
    book = nbformat.read(file, as_version=4)
    nbformat.validate(book)
    book.cells[-1].source = f"main({list(options)!r})"
    nbclient.NotebookClient(book, kernel_name="own", timeout=900, resources={"metadata": {"path": str(file.parent)}}).execute()
    shown = [output for cell in book.cells if cell.cell_type == "code" for output in cell.outputs]
    text = "".join(output.get("text", "") for output in shown)
    return text, any("image/png" in output.get("data", {}) for output in shown)


def test_there_is_one_for_each_example(tmp_path):
    """Each starts with a title, and has all of the script but its options of the shell."""
    books = made(tmp_path)
    assert [b.stem for b in books] == sorted(e.stem for e in (PYTHON / "Examples").glob("*.py"))
    for file in books:
        book = nbformat.read(file, as_version=4)
        nbformat.validate(book)
        assert book.cells[0].cell_type == "markdown" and book.cells[0].source.startswith("# ")
        code = "\n".join(cell.source for cell in book.cells if cell.cell_type == "code")
        script = (PYTHON / "Examples" / f"{file.stem}.py").read_text().partition('"""\nimport')[2]
        for line in script.partition('if __name__ == "__main__"')[0].splitlines():
            assert line in code, (file.stem, line)


def test_collision(tmp_path, monkeypatch):
    text, hasPicture = run(*made(tmp_path, "collision.py"), monkeypatch)
    assert "ruptures" in text and hasPicture


def test_progress_is_shown(tmp_path, monkeypatch):
    """A plate that has hardly begun to bend; the bar is that of tqdm where it is installed."""
    text, hasPicture = run(*made(tmp_path, "plate.py"), monkeypatch, ("--time", "0.004"))
    assert "below the ends" in text and hasPicture and "0.004" in text
