"""Runs in the browser, from Python: the program view beside this package, started once for each folder."""
import atexit
import os
import re
import sys
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Union

from . import _kernel
from .results import Path

# What only view() needs it imports itself: these modules take longer than all others of the package.
if TYPE_CHECKING:
    import subprocess

_servers: Dict[Tuple[str, str], Tuple["subprocess.Popen[str]", str]] = {}  # by folder and frame_of: with its address


def _command() -> List[str]:
    """The program of the build that this package is in, or that of an installed package."""
    build = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    program = os.environ.get("PENDULAR_VIEW") or os.path.join(build, "Tools", "view")
    if os.access(program, os.X_OK):
        return [program]
    import shutil

    installed = shutil.which("pendular")
    if installed:
        return [installed, "view"]
    raise _kernel.InputError("view() finds no program view: build it (view.sh of the source), install the Debian package, or name it by "
                             "PENDULAR_VIEW in the environment.")


def _place(run: Union[Path, "_kernel.Scene"]) -> Tuple[str, str]:
    """The folder, and the run in it; no run: all of them."""
    name = os.fspath(run.name) if isinstance(run, _kernel.Scene) else os.fspath(run)
    if os.path.isdir(name) and not isinstance(run, _kernel.Scene):
        return os.path.realpath(name), ""
    folder, run_name = os.path.split(os.path.abspath(name))
    if not os.path.isdir(folder):
        raise _kernel.InputError(f"There is no folder {folder} with runs.")
    return os.path.realpath(folder), run_name


def _text_of(name: str) -> str:
    """As the server writes the name of a run: what is no UTF-8 is "%E9", and "%" is "%25" (NameText.h)."""
    return re.sub("[\udc80-\udcff]", lambda byte: f"%{ord(byte[0]) - 0xdc00:02X}", name.replace("%", "%25"))


def _start(folder: str, frame_of: str) -> Tuple["subprocess.Popen[str]", str]:
    """It ends with this process: then nothing more can come from its input."""
    import subprocess

    server = subprocess.Popen([*_command(), folder, "--end-with-input", "--frame-of", frame_of], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
    assert server.stdout is not None and server.stderr is not None
    for line in server.stdout:
        if re.match(r"http://\S+$", line):
            atexit.register(server.terminate)
            return server, line.strip()
    server.wait()
    raise _kernel.InputError(server.stderr.read().strip().replace("Error: ", "", 1) or "The program view has not started.")


def _is_notebook() -> bool:
    get_ipython: Any = getattr(sys.modules.get("IPython"), "get_ipython", None)
    shell = get_ipython() if get_ipython else None
    return getattr(shell, "kernel", None) is not None


def view(run: Union[Path, "_kernel.Scene"] = ".", *, height: int = 700, frame_of: str = "http://localhost:*") -> Optional[Any]:
    """Shows a run, or all runs of a folder, in the browser: in a notebook as a frame of it, which is returned;
    elsewhere it prints the address. The server is started once for a folder, and ends with this process.

    run: a folder; the name of a run, what its files begin with ("results/drum"); or a Scene. height: of the
    frame, pixels. frame_of: the address of the notebook, as far as the host's name and port; the name must be that of the
    browser's address line, or it keeps back the cookie.
    """
    from urllib.parse import quote

    folder, name = _place(run)
    server = _servers.get((folder, frame_of))
    if server is None or server[0].poll() is not None:
        server = _servers[folder, frame_of] = _start(folder, frame_of)
    address = server[1] + (f"&run={quote(_text_of(name), safe='')}" if name else "")
    if not _is_notebook():
        print(address)
        return None
    from IPython.display import IFrame

    return IFrame(address, "100%", height)
