"""The types that pybind11 writes into docstrings differ between its versions; what the package makes of them does not."""
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
