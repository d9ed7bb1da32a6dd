"""Which compiled module: a package for any x86-64 has one for each level of the processor. All give the same bits."""
import os
import sys
from typing import List, Optional, Set

# The flags of /proc/cpuinfo that a level asks for besides those of the level before.
_LEVELS = [
    ("x86-64-v2", {"cx16", "popcnt", "ssse3", "sse4_1", "sse4_2"}),
    ("x86-64-v3", {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "abm"}),
    ("x86-64-v4", {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"}),
]


def levels(cpuinfo: str = "/proc/cpuinfo") -> List[str]:
    """The levels that this processor has, the best one first."""
    try:
        with open(cpuinfo) as file:
            flags: Set[str] = next((set(line.split()) for line in file if line.startswith("flags")), set())
    except OSError:
        return [_LEVELS[0][0]]  # not known, as without /proc: what nearly all have
    found: List[str] = []
    for level, needed in _LEVELS:
        if not needed <= flags:
            break
        found.insert(0, level)
    return found


def _has_module(folder: str) -> bool:
    return os.path.isdir(folder) and any(file.startswith("_kernel.") for file in os.listdir(folder))


def folder(package: str, cpuinfo: str = "/proc/cpuinfo") -> Optional[str]:
    """The folder of the module; None where the package has but one. PENDULAR_LEVEL in the environment asks for another."""
    have = [name for name, _ in _LEVELS if _has_module(os.path.join(package, name))]
    if not have:
        return None
    asked = os.environ.get("PENDULAR_LEVEL")
    for level in [asked] if asked else levels(cpuinfo):
        if level in have:
            return os.path.join(package, level)
    raise ImportError(f"pendular has its kernel for {', '.join(have)}; this processor has none of them." if not asked
                      else f"PENDULAR_LEVEL is {asked}; pendular has its kernel for {', '.join(have)}.")


def choose(package: str, path: List[str]) -> None:
    chosen = folder(package) if sys.platform == "linux" else None
    if chosen:
        path.insert(0, chosen)
