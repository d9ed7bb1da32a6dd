"""The log of the kernel goes to sys.stderr as Python has it, so that a notebook shows it; runs of other threads stop before
the interpreter ends."""
import atexit
import sys

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


def show_log() -> None:
    _kernel._set_log(_write)
    atexit.register(_kernel._set_log, None)
    atexit.register(_kernel._stop_all)  # called first
