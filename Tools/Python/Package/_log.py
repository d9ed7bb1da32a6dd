"""The log of the kernel goes to sys.stderr as Python has it, so that a notebook shows it, and its warnings to Python's
`warnings`; runs of other threads stop before the interpreter ends."""
import atexit
import os
import sys
import warnings
from typing import Any

from . import _kernel

_WARNING, _PROGRESS = 1, 5  # levels: of what is wrong, and of lines that stand for the one before
_HERE = os.path.dirname(os.path.abspath(__file__))


class SceneWarning(UserWarning):
    """What a scene warns of: values that are likely slips, and laws that are used where they are not made for it."""


def _warn(text: str) -> None:
    """As from the line of the script that called the package."""
    depth, frame = 2, sys._getframe(1)
    while frame.f_back is not None and os.path.abspath(frame.f_code.co_filename).startswith(_HERE):
        depth, frame = depth + 1, frame.f_back
    warnings.warn(text, SceneWarning, stacklevel=depth)


def _write(level: int, text: str) -> None:
    if level == _WARNING:
        _warn(text)
        return
    stream = sys.stderr
    if stream is None:
        return
    if level == _PROGRESS:
        stream.write("\r" + text + " ")
    else:
        stream.write(text + "\n")
    stream.flush()


def _tell_ranks(kind: Any, error: Any, trace: Any) -> None:
    """The others end with this one, which would else be waited for."""
    sys.__excepthook__(kind, error, trace)
    _kernel._fail_on_ranks(f"{kind.__name__}: {error}")


def show_log() -> None:
    script = os.path.basename(sys.argv[0]) if getattr(sys, "argv", None) else ""
    _kernel._set_program(script if script not in ("", "-c", "-m") else "python")
    _kernel._set_log(_write)
    atexit.register(_kernel._set_log, None)
    atexit.register(_kernel._stop_all)  # called first
    if _kernel.rank_count() > 1:
        sys.excepthook = _tell_ranks
