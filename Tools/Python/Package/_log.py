"""The log of the kernel goes to sys.stderr as Python has it, so that a notebook shows it; runs of other threads stop before
the interpreter ends."""
import atexit
import sys
from typing import Any

from . import _kernel

_PROGRESS = 5  # the level of lines that stand for the one before


def _write(level: int, text: str) -> None:
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
    _kernel._set_log(_write)
    atexit.register(_kernel._set_log, None)
    atexit.register(_kernel._stop_all)  # called first
    if _kernel.rank_count() > 1:
        sys.excepthook = _tell_ranks
