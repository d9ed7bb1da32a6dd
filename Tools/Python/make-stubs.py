#!/usr/bin/env python3
"""Writes _kernel.pyi, the types of the compiled module, from the signatures that pybind11 puts into docstrings.

    make-stubs.py OUTPUT.pyi        (with the folder of the module in PYTHONPATH)
"""
import importlib
import inspect
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "Package"))
from _signature import signature  # noqa: E402  (of the package, which needs numpy)

HEAD = '''# Written by make-stubs.py from the module.
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike as _NumpyArrayLike

ArrayLike = Union[_NumpyArrayLike, Sequence[Any]]
Vector = Union[Sequence[float], numpy.ndarray]

class _Array:
    def __get__(self, instance: Any, owner: Any) -> numpy.ndarray: ...
    def __set__(self, instance: Any, value: ArrayLike) -> None: ...
'''
TYPES = [(r"(?:pendular\.)?_kernel\.", ""), (r"\bobject\b", "Any"),
         (r"\bfunction\b", "Callable[..., Any]"), (r"\bos\.PathLike\b", "Union[str, os.PathLike[str]]"),
         (r"(?<![\w\[])dict\b", "Dict[str, Any]"), (r"\btuple\b", "Tuple[Any, ...]"), (r"\blist\b", "List[Any]")]


def typed(text):
    for pattern, by in TYPES:
        text = re.sub(pattern, by, text)
    if "::" in text:
        sys.exit(f"make-stubs.py: {text} is a type of C++; register its class before the function that has it.")
    return text


def header(doc):
    """(arguments, type of the answer), or None."""
    found = signature(doc)
    if not found:
        return None
    arguments = []
    for name, kind, default in found.arguments:
        if not kind:
            arguments.append({"**kwargs": "**kwargs: float"}.get(name, name))
        elif name in ("self", "arg0") and not arguments:
            arguments.append("self")
        else:
            kind = typed(kind).replace("List[", "Sequence[")
            if default == "None" and not kind.startswith(("Optional", "Any")):
                kind = f"Optional[{kind}]"
            arguments.append(f"{name}: {kind}" + (" = ..." if default is not None else ""))
    return ", ".join(arguments), "numpy.ndarray" if found.answer == "Vector" else typed(found.answer)


def text_of(doc, indent):
    text = "\n".join((doc or "").splitlines()[1:]).strip()
    if not text:
        return " ..."
    body = text.replace("\\", "\\\\").replace('"""', "'''").replace("\n", "\n" + indent)
    return f'\n{indent}r"""{body}"""\n{indent}...' if "\\" in text else f'\n{indent}"""{body}"""\n{indent}...'


def function(name, value, indent):
    found = header(value.__doc__)
    if not found:
        return None
    arguments, answer = found
    return f"{indent}def {name}({arguments}) -> {answer}:{text_of(value.__doc__, indent + '    ')}\n"


def attribute(name, value):
    """A property."""
    getter = header(value.fget.__doc__)
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
