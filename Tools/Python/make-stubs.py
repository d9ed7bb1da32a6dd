#!/usr/bin/env python3
"""Writes _kernel.pyi, the types of the compiled module, from the signatures that pybind11 puts into docstrings.

    make-stubs.py OUTPUT.pyi        (with the folder of the module in PYTHONPATH)
"""
import importlib
import inspect
import re
import sys
from pathlib import Path

HEAD = '''# Written by make-stubs.py from the module.
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike

Vector = Union[Sequence[float], numpy.ndarray]

class _Array:
    def __get__(self, instance: Any, owner: Any) -> numpy.ndarray: ...
    def __set__(self, instance: Any, value: ArrayLike) -> None: ...
'''
TYPES = [(r"(?:pendular\.)?_kernel\.", ""), (r"numpy\.ndarray\[[\w.]+\]", "numpy.ndarray"), (r"\bobject\b", "Any"),
         (r"\bfunction\b", "Callable[..., Any]"), (r"\bos\.PathLike\b", "Union[str, os.PathLike[str]]"),
         (r"(?<![\w\[])dict\b", "Dict[str, Any]"), (r"\btuple\b", "Tuple[Any, ...]"), (r"\blist\b", "List[Any]")]


def typed(text):
    for pattern, by in TYPES:
        text = re.sub(pattern, by, text)
    if "::" in text:
        sys.exit(f"make-stubs.py: {text} is a type of C++; register its class before the function that has it.")
    return text


def split(arguments):
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


def signature(doc, name):
    """(arguments, type of the answer), or None."""
    found = re.match(rf"{re.escape(name)}\((.*)\) -> (.+?)$", (doc or "").splitlines()[0] if doc else "")
    if not found:
        return None
    arguments = []
    for part in split(found[1]):
        own, default = (part.split(" = ", 1) + [None])[:2] if " = " in part else (part, None)
        key, _, kind = own.partition(": ")
        if not kind:
            arguments.append({"**kwargs": "**kwargs: float"}.get(key, key))
        elif key in ("self", "arg0") and not arguments:
            arguments.append("self")
        else:
            kind = typed(kind)
            if default == "None" and not kind.startswith(("Optional", "Any")):
                kind = f"Optional[{kind}]"
            arguments.append(f"{key}: {kind}" + (" = ..." if default is not None else ""))
    answer = "numpy.ndarray" if found[2] == "Vector" else typed(found[2])
    return ", ".join(arguments), answer


def text_of(doc, indent):
    text = "\n".join((doc or "").splitlines()[1:]).strip()
    if not text:
        return " ..."
    body = text.replace("\\", "\\\\").replace('"""', "'''").replace("\n", "\n" + indent)
    return f'\n{indent}r"""{body}"""\n{indent}...' if "\\" in text else f'\n{indent}"""{body}"""\n{indent}...'


def function(name, value, indent):
    found = signature(value.__doc__, name)
    if not found:
        return None
    arguments, answer = found
    return f"{indent}def {name}({arguments}) -> {answer}:{text_of(value.__doc__, indent + '    ')}\n"


def attribute(name, value):
    """A property."""
    getter = signature("f" + (value.fget.__doc__ or "").strip(), "f")
    if not getter:
        return None
    if value.fset and "numpy" in getter[1]:
        return f"    {name}: _Array\n"
    doc = f'\n        """{value.__doc__}"""\n        ...' if value.__doc__ else " ..."
    text = f"    @property\n    def {name}(self) -> {getter[1]}:{doc}\n"
    if value.fset:
        text += f"    @{name}.setter\n    def {name}(self, value: {getter[1]}) -> None: ...\n"
    return text


def of_class(name, value):
    base = value.__bases__[0].__name__
    text = f"\nclass {name}" + ("" if base in ("object", "pybind11_object") else f"({base})") + ":\n"
    parts = [f'    """{inspect.cleandoc(value.__doc__)}"""\n'] if value.__doc__ and base != "object" else []
    for key, member in sorted(vars(value).items()):
        if key.startswith("__") and key not in ("__init__", "__len__"):
            continue
        if isinstance(member, property):
            parts.append(attribute(key, member))
        elif callable(member):
            parts.append(function(key, member, "    "))
    return text + ("".join(p for p in parts if p) or "    ...\n")


def main():
    module = importlib.import_module("_kernel")  # without the package, which needs numpy
    text = HEAD
    for name, value in sorted(vars(module).items()):
        if isinstance(value, type):
            text += of_class(name, value)
        elif callable(value):
            made = function(name, value, "")
            text += "\n" + made if made else ""
        elif name == "__version__":
            text += f"\n{name}: str\n"
    Path(sys.argv[1]).write_text(text)


if __name__ == "__main__":
    main()
