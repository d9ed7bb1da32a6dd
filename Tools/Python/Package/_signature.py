"""The signatures of the compiled module, which pybind11 writes into the first lines of docstrings."""
import re
from typing import List, NamedTuple, Optional


class Argument(NamedTuple):
    name: str
    kind: str = ""  # as pybind11 writes it; empty of *, *args and **kwargs
    default: Optional[str] = None


class Signature(NamedTuple):
    arguments: List[Argument]
    answer: str


def split(arguments: str) -> List[str]:
    """At commas outside of brackets and quotes."""
    parts, depth, now, quote = [], 0, "", ""
    for letter in arguments:
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        depth += (letter in "([{<") - (letter in ")]}>") if not quote else 0
        if letter == "," and depth == 0 and not quote:
            parts.append(now.strip())
            now = ""
        else:
            now += letter
    return parts + [now.strip()] if now.strip() else parts


def signature(doc: Optional[str]) -> Optional[Signature]:
    """Of a function with this docstring; None where it has none."""
    found = re.match(r"\w*\((.*)\) -> (.+?)$", doc.splitlines()[0]) if doc else None
    if not found:
        return None
    arguments = []
    for part in split(found[1]):
        own, _, default = part.partition(" = ")
        name, _, kind = own.partition(": ")
        arguments.append(Argument(name, kind, default if " = " in part else None))
    return Signature(arguments, found[2])
