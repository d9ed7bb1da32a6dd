"""The types that pybind11 writes into docstrings differ between its versions; what the package makes of them does not."""
import inspect
import re
from pathlib import Path

import pytest

import pendular
from pendular._signature import Argument, Signature, plain, signature

# Types of arguments and answers as pybind11 2.10, 2.13 and 3.0 write them.
WRITTEN = {
    "float": ["float", "typing.SupportsFloat | typing.SupportsIndex"],
    "int": ["int", "typing.SupportsInt | typing.SupportsIndex"],
    "object": ["object", "typing.Any"],
    "os.PathLike": ["os.PathLike", "Union[os.PathLike, str, bytes]", "os.PathLike | str | bytes", "pathlib.Path"],
    "List[float]": ["List[float]", "list[float]", "collections.abc.Sequence[typing.SupportsFloat]"],
    "List[int]": ["List[int[3]]", "Annotated[list[int], FixedSize(3)]",
                  'Annotated[collections.abc.Sequence[typing.SupportsInt], "FixedSize(3)"]'],
    "Dict[str, float]": ["Dict[str, float]", "dict[str, float]", "collections.abc.Mapping[str, typing.SupportsFloat]"],
    "Optional[function]": ["Optional[function]", "Optional[Callable]", "collections.abc.Callable | None"],
    "Optional[Tuple[Vector, float, float]]": ["Optional[Tuple[Vector, float, float]]", "tuple[Vector, float, float] | None"],
    "List[pendular._kernel.Species]": ["List[pendular._kernel.Species]", "list[pendular._kernel.Species]"],
    "numpy.ndarray": ["numpy.ndarray[numpy.float64]", "numpy.typing.NDArray[numpy.float64]"],
    "dict": ["dict"], "list": ["list"], "tuple": ["tuple"],
}


@pytest.mark.parametrize("kind, written", [(kind, one) for kind, all_of_it in WRITTEN.items() for one in all_of_it])
def test_all_versions_of_pybind11_write_the_same_types(kind, written):
    assert plain(written) == kind
    assert signature(f"run(self: T, a: {written}, *, b: str = 'x, y', **kwargs) -> {written}\n\nHelp.") == Signature(
        [Argument("self", "T"), Argument("a", kind), Argument("*"), Argument("b", "str", "'x, y'"), Argument("**kwargs")], kind)


def test_every_type_of_the_stubs_has_a_name():
    text = (Path(pendular.__file__).parent / "_kernel.pyi").read_text()
    known = set(re.findall(r"^class (\w+)", text, flags=re.M)) | {
        name.strip() for line in re.findall(r"^from \w\S* import (.*)$", text, flags=re.M) for name in line.split(",")}
    used = {name for line in re.findall(r"^ *def .*$", text, flags=re.M) for name in re.findall(r"(?<![.\w])[A-Z]\w+", re.sub(r"'[^']*'", "", line))}
    assert used and used <= known | {"ArrayLike", "Vector", "None"}, used - known


def help_of(thing, seen):
    """The texts of a module's classes and functions, and of theirs."""
    for name in dir(thing):
        one = getattr(thing, name)
        if name.startswith("_") or inspect.ismodule(one) or id(one) in seen:
            continue
        seen.add(id(one))
        yield name, inspect.getdoc(one) or ""
        if inspect.isclass(one):
            yield from help_of(one, seen)


def test_help_speaks_of_python():
    """Classes and functions of C++ have other names here; "for set()" was what was left of one."""
    texts = dict(help_of(pendular, set()))
    assert len(texts) > 200 and "add_solid" in texts
    of_cpp = {name: found for name, text in texts.items()
              if (found := re.findall(r"\w*::\w*|\b(?!dV\b)[a-z]+[A-Z]\w*|\b\w+(?:Wall|Handler|Cylinder)\b|(?<![.\w])set\(\)", text))}
    assert of_cpp == {}
