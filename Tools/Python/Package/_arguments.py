"""What is said of arguments that a function of the compiled module does not take: one sentence, which names the argument."""
from __future__ import annotations

import operator
import os
import re
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

from . import _kernel
from ._signature import Argument, signature, split


def _is_number(value: Any) -> bool:
    try:
        return not isinstance(value, (str, bytes)) and float(value) is not None
    except (TypeError, ValueError, OverflowError):
        return False


def _is_whole(value: Any) -> bool:
    try:
        return operator.index(value) is not None
    except TypeError:
        return False


def _is_vector(value: Any) -> bool:
    try:
        return np.asarray(value).dtype.kind in "bifu" and np.shape(value) == (3,)
    except ValueError:
        return False


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, bytes, os.PathLike))


# By the type as _signature.plain() writes it: what it takes, and in words.
_KINDS: Dict[str, Tuple[Callable[[Any], bool], str]] = {
    "float": (_is_number, "a number"),
    "int": (_is_whole, "a whole number"),
    "bool": (lambda v: hasattr(v, "__bool__"), "True or False"),
    "str": (lambda v: isinstance(v, (str, bytes)), "text"),
    "os.PathLike": (_is_path, "the name of a file"),
    "function": (callable, "a function"),
    "dict": (lambda v: isinstance(v, dict), "a dict"),
    "Vector": (_is_vector, "three numbers"),
    "ArrayLike": (lambda v: v is not None, "numbers"),
    "object": (lambda v: True, "something"),
}
_PARTS = {"List": "a list", "Sequence": "a list", "Dict": "a dict", "Tuple": "a tuple"}
# Names of functions that methods of the package call.
_CALLED_BY = {"_run_to": "run", "_run_steps": "run", "_collisions": "collisions"}
_NO_MEMORY = "There is not enough memory."  # of ExplainArguments.h
_UNIT = r"(?:1|s|m|kg|N|K|Pa|J|W|rad)(?:\^\d)?"


def _takes(kind: str, value: Any) -> bool:
    whole, _, inner = kind.partition("[")
    if whole == "Optional":
        return value is None or _takes(inner[:-1], value)
    if whole == "Dict":
        return isinstance(value, dict) and all(_takes(split(inner[:-1])[1], one) for one in value.values())
    if whole in ("List", "Sequence"):
        return isinstance(value, (list, tuple)) and all(_takes(inner[:-1], one) for one in value)
    if whole == "Tuple":
        kinds = split(inner[:-1])
        return isinstance(value, (list, tuple)) and len(value) == len(kinds) and all(map(_takes, kinds, value))
    if kind in _KINDS:
        return _KINDS[kind][0](value)
    own = getattr(_kernel, kind.rpartition(".")[2], None)
    return isinstance(value, own) if isinstance(own, type) else True


def _words(kind: str) -> str:
    whole, _, inner = kind.partition("[")
    if whole == "Optional":
        return f"{_words(inner[:-1])}, or None"
    if whole in _PARTS:
        return f"{_PARTS[whole]} of {' and '.join(map(_several, split(inner[:-1])))}"
    if kind in _KINDS:
        return _KINDS[kind][1]
    name = kind.rpartition(".")[2]
    return f"{'an' if name[0] in 'AEIOU' else 'a'} {name}"


def _several(kind: str) -> str:
    """numbers, for a number"""
    words = _words(kind)
    return words[2:].rstrip("s") + "s" if words.startswith("a ") else words


def _shown(value: Any) -> str:
    """In one line."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _unit(attribute: Any) -> str:
    """ (s), by the first words of its help."""
    found = re.match(rf"{_UNIT}(?:[ /]{_UNIT})*(?=[;,]|$)", attribute.__doc__ or "")
    return f" ({found[0]})" if found else ""


def _wrong_kind(label: str, argument: Argument, value: Any, unit: str = "") -> str:
    return f"{label} = {_shown(value)} must be {_words(argument.kind)}{unit}."


def _fault(name: str, takes: List[Argument], given: Tuple[Any, ...], named: Dict[str, Any]) -> str:
    """What is wrong with a call; empty where that is not seen."""
    names = [a.name for a in takes if a.kind]
    by_place = names[:[*[a.name for a in takes], "*"].index("*")]
    has = f"it has {', '.join(names)}" if names else "it has none"
    takes_any = bool(takes) and takes[-1].name.startswith("**")
    for key in named:
        if key not in names and not takes_any:
            import difflib  # for mistakes only

            near = difflib.get_close_matches(key, names, 1)
            return f"{name}() has no argument {key}; {f'did you mean {near[0]}? I' if near else 'i'}{has[1:]}."
    if len(given) > len(by_place):
        if not names:
            return f"{name}() takes no arguments."
        if not by_place:
            return f"{name}() takes its arguments by name, as {names[0]}=...; {has}."
        return f"{name}() takes {len(by_place)} without a name: {', '.join(by_place)}; {len(given)} are given. All: {', '.join(names)}."
    values = dict(zip(by_place, given))
    for key in named:
        if key in values:
            return f"{name}() is given {key} twice."
    values.update((key, value) for key, value in named.items() if key in names)
    missing = [a.name for a in takes if a.kind and a.default is None and a.name not in values]
    if missing:
        return f"{name}() also needs {' and '.join(missing)}; {has}."
    return _fault_of_values(name, [(a, values[a.name]) for a in takes if a.name in values])


def _fault_of_values(name: str, of_call: List[Tuple[Argument, Any]]) -> str:
    for argument, value in of_call:
        if not _takes(argument.kind, value):
            return f"{name}(): " + _wrong_kind(argument.name, argument, value)
    for argument, value in of_call:
        if argument.kind in ("int", "Optional[int]") and value is not None and not 0 <= value < 2**31:
            return f"{name}(): {argument.name} = {_shown(value)} must be a whole number, at least 0 and below 2^31."
    return ""


def _no_memory(name: str, given: Tuple[Any, ...], named: Dict[str, Any], takes: List[Argument]) -> str:
    """Of numbers it says which."""
    values = {**dict(zip([a.name for a in takes if a.kind], given)), **named}
    numbers = [f"{key} = {_shown(value)}" for key, value in values.items()
               if not isinstance(value, bool) and np.ndim(value) == 0 and _is_number(value)]
    return f"{name}() has not enough memory for {' and '.join(numbers) or 'what it makes'}; ask for less."


def explain(said: Optional[str], name: str, doc: str, given: Tuple[Any, ...], named: Dict[str, Any], attribute: Any) -> str:
    """The sentence.

    said: what stands where nothing better is found, or None; name: of the function, or of the class that is made; doc: its
    docstring; attribute: one that is assigned, or None.
    """
    found = signature(doc)
    takes, name = found.arguments if found else [], _CALLED_BY.get(name, name)
    if takes and takes[0].name in ("self", "arg0"):
        if not given or not _takes(takes[0].kind, given[0]):
            return f"{name} is of {_words(takes[0].kind)}, and nothing else has it."
        takes, given = takes[1:], given[1:]
    if said == _NO_MEMORY:
        return _no_memory(name, given, named, takes)
    if attribute is not None:
        return _wrong_kind(name, takes[-1], given[-1], _unit(attribute))
    fault = _fault(name, takes, given, named) if found else ""
    if not fault and said is None:
        return f"{name}() does not take these arguments together: {', '.join(map(_shown, [*given, *named.values()]))}."
    return fault or said or ""


_kernel._set_explanation(explain)
