"""pendular.view(): the server is started once for a folder, and its address shown, or a frame of it."""
import os
import re
import subprocess
import sys
import urllib.request

import pytest

import pendular
from conftest import tower
from pendular import _view

PROGRAM = os.environ.get("PENDULAR_VIEW", "")
pytestmark = pytest.mark.skipif(not os.access(PROGRAM, os.X_OK), reason="the program view is not built")


@pytest.fixture(autouse=True)
def page(tmp_path_factory, monkeypatch):
    """The program with a page of two files: npm may not be there. All servers end with the test."""
    folder = tmp_path_factory.mktemp("page")
    (folder / "main.js").write_text("")
    (folder / "index.html").write_text("the page")
    program = folder / "view"
    program.write_text(f'#!/bin/sh\nexec "{PROGRAM}" "$@" --page "{folder}"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PENDULAR_VIEW", str(program))
    yield
    for server, _ in _view._servers.values():
        server.terminate()
        assert server.wait(20) == 0
    _view._servers.clear()


def shown(capsys):
    return capsys.readouterr().out.strip()


def test_names_that_are_no_utf8_have_the_text_of_the_server():
    assert pendular._view._text_of("caf\udce9/100%") == "caf%E9/100%25"
    assert pendular._view._text_of("café/run") == "café/run"


def test_it_prints_an_address_that_answers(capsys):
    scene = tower("results/run")
    scene.write_paraview(1e-3)
    scene.run(1e-3)
    scene.finish()
    assert pendular.view("results") is None
    folder = shown(capsys)
    address, token = re.fullmatch(r"(http://localhost:\d+/)\?token=([0-9a-f]{32})", folder).groups()
    for given in (scene, "results/run"):
        pendular.view(given)
        assert shown(capsys) == f"{folder}&run=run"  # the same server
    answer = urllib.request.urlopen(f"{folder}&run=run")
    assert b"url=.#run=run" in answer.read() and "localhost:*" in answer.headers["Content-Security-Policy"]
    asked = urllib.request.Request(address + "api/runs", headers={"Cookie": answer.headers["Set-Cookie"].split(";")[0]})
    assert b'"id":"run"' in urllib.request.urlopen(asked).read()
    server = _view._servers[os.path.realpath("results"), "http://localhost:*"][0]
    server.terminate()  # ended from elsewhere: it is started again
    server.wait(20)
    pendular.view("results")
    assert urllib.request.urlopen(shown(capsys)).status == 200


def test_in_a_notebook_it_is_a_frame(monkeypatch, tmp_path):
    pytest.importorskip("IPython")
    monkeypatch.setattr(_view, "_is_notebook", lambda: True)
    frame = pendular.view(tmp_path, height=300)
    html = frame._repr_html_()
    assert 'height="300"' in html and re.search(r'src="http://localhost:\d+/\?token=[0-9a-f]{32}"', html)


def test_what_a_notebook_is():
    pytest.importorskip("nbclient")
    import nbformat
    from nbclient import NotebookClient

    cells = [nbformat.v4.new_code_cell("import pendular; pendular.view('.')")]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, timeout=120).execute()
    assert "<iframe" in notebook.cells[0].outputs[0]["data"]["text/html"]


def test_it_ends_with_the_program_that_has_started_it():
    for end in ("", "os.kill(os.getpid(), 9)"):
        done = subprocess.run([sys.executable, "-c", f"import os, pendular; pendular.view('.'); print(pendular._view._servers.popitem()[1][0].pid, flush=True); {end}"],
                              capture_output=True, text=True)
        process = int(done.stdout.split()[-1])
        for _ in range(100):
            if not os.path.exists(f"/proc/{process}/exe") or not os.readlink(f"/proc/{process}/exe"):
                break
            subprocess.run(["sleep", "0.1"], check=True)
        else:
            pytest.fail("the server goes on")


def test_what_cannot_be_shown(monkeypatch):
    with pytest.raises(pendular.InputError, match="There is no folder"):
        pendular.view("no/such/run")
    with pytest.raises(pendular.InputError, match="--frame-of must be one address"):
        pendular.view(".", frame_of="a b")
    monkeypatch.delenv("PENDULAR_VIEW")
    monkeypatch.setattr(_view, "__file__", "/nowhere/a/b/c.py")
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(pendular.InputError, match="finds no program view"):
        pendular.view(".", frame_of="http://localhost:1")
