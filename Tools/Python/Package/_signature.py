"""The signatures of the compiled module, which pybind11 writes into the first lines of docstrings."""
import re
from typing import List, NamedTuple, Optional


class Argument(NamedTuple):
    name: str
    kind: str = ""  # by plain(); empty of *, *args and **kwargs
    default: Optional[str] = None


class Signature(NamedTuple):
    arguments: List[Argument]
    answer: str


def split(arguments: str, mark: str = ",") -> List[str]:
    """At commas, or other marks, outside of brackets and quotes."""
    parts, depth, now, quote = [], 0, "", ""
    for letter in arguments:
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        depth += (letter in "([{<") - (letter in ")]}>") if not quote else 0
        if letter == mark and depth == 0 and not quote:
            parts.append(now.strip())
            now = ""
        else:
            now += letter
    return parts + [now.strip()] if now.strip() else parts


# What versions of pybind11 write for the same type: 2.10 List[float], 2.12 list[float], 3.0 collections.abc.Sequence[float].
_SAME = {"list": "List", "Sequence": "List", "dict": "Dict", "Mapping": "Dict", "tuple": "Tuple", "Callable": "function",
         "SupportsFloat": "float", "SupportsInt": "int", "SupportsIndex": "int", "PathLike": "os.PathLike", "Path": "os.PathLike",
         "Any": "object", "NDArray": "numpy.ndarray"}


def plain(kind: str) -> str:
    """A type in the words of pybind11 2.10, by whatever version it is written.

    Without brackets also list, dict and tuple stay, which pybind11 writes for its own classes of these names.
    """
    options = split(kind, "|")
    whole, bracket, inner = kind.partition("[")
    whole = re.sub(r"^(typing|collections\.abc|numpy\.typing|pathlib|os)\.", "", whole)
    parts = split(inner[:-1])
    if len(options) == 1 and whole == "Union":
        options = parts
    if len(options) > 1:
        return _one_of([plain(one) for one in options])
    if whole == "Annotated":
        return plain(parts[0])
    name = whole if not bracket and whole in ("list", "dict", "tuple") else _SAME.get(whole, whole)
    if not bracket or name in ("function", "numpy.ndarray") or parts[0].isdigit():  # int[3], of a list of three
        return name
    return f"{name}[{', '.join(map(plain, parts))}]"


def _one_of(kinds: List[str]) -> str:
    """A union, but for what pybind11 writes so of one type."""
    others = [one for one in dict.fromkeys(kinds) if one != "None"]
    if "float" in others:
        others = [one for one in others if one != "int"]
    if "os.PathLike" in others:
        others = ["os.PathLike"]
    one = others[0] if len(others) == 1 else f"Union[{', '.join(others)}]"
    return f"Optional[{one}]" if "None" in kinds else one


def signature(doc: Optional[str]) -> Optional[Signature]:
    """Of a function with this docstring; None where it has none."""
    found = re.match(r"\w*\((.*)\) -> (.+?)$", doc.splitlines()[0]) if doc else None
    if not found:
        return None
    arguments = []
    for part in split(found[1]):
        own, _, default = part.partition(" = ")
        name, _, kind = own.partition(": ")
        arguments.append(Argument(name, plain(kind), default if " = " in part else None))
    return Signature(arguments, plain(found[2]))
