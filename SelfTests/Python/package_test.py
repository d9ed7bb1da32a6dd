"""What is around the module: the choice of the processor's level, documentation."""
import inspect
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import pendular
from pendular._choose import folder, levels

V2 = "cx16 popcnt ssse3 sse4_1 sse4_2 "
V3 = V2 + "avx avx2 bmi1 bmi2 f16c fma movbe abm "
V4 = V3 + "avx512f avx512bw avx512cd avx512dq avx512vl "


@pytest.mark.parametrize("flags, best", [(V4, "x86-64-v4"), (V3, "x86-64-v3"), (V3.replace("fma", ""), "x86-64-v2"),
                                         (V2, "x86-64-v2"), (V4.replace("abm", ""), "x86-64-v2")])
def test_level_of_the_processor(tmp_path, flags, best):
    """Flags as /proc/cpuinfo has them; a level needs all before it."""
    (tmp_path / "cpuinfo").write_text(f"processor : 0\nflags : fpu {flags}\n")
    assert levels(str(tmp_path / "cpuinfo"))[0] == best


def test_level_where_the_system_tells_nothing(tmp_path):
    assert levels(str(tmp_path / "nothing")) == ["x86-64-v2"]


def test_the_package_imports_only_what_each_program_needs():
    """What only the browser, refusals and pictures need takes longer than all else but the kernel."""
    code = "import sys, numpy; before = set(sys.modules); import pendular; print(*set(sys.modules) - before)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pendular._kernel" in done.stdout.split()
    assert not {"subprocess", "shutil", "difflib", "urllib.parse", "pandas", "matplotlib"} & set(done.stdout.split())


def test_folder_of_the_module(tmp_path, monkeypatch):
    monkeypatch.delenv("PENDULAR_LEVEL", raising=False)
    (tmp_path / "cpuinfo").write_text(f"flags : {V4}\n")
    cpuinfo = str(tmp_path / "cpuinfo")
    assert folder(str(tmp_path), cpuinfo) is None  # a module of one build
    for level in ("x86-64-v2", "x86-64-v3", "x86-64-v4"):
        (tmp_path / level).mkdir()
    assert folder(str(tmp_path), cpuinfo) is None  # nothing is built yet
    for level in ("x86-64-v2", "x86-64-v3"):
        (tmp_path / level / "_kernel.so").touch()
    assert folder(str(tmp_path), cpuinfo).endswith("x86-64-v3")
    monkeypatch.setenv("PENDULAR_LEVEL", "x86-64-v2")
    assert folder(str(tmp_path), cpuinfo).endswith("x86-64-v2")
    monkeypatch.setenv("PENDULAR_LEVEL", "x86-64-v4")
    with pytest.raises(ImportError, match="PENDULAR_LEVEL is x86-64-v4"):
        folder(str(tmp_path), cpuinfo)
    monkeypatch.delenv("PENDULAR_LEVEL")
    (tmp_path / "cpuinfo").write_text("flags : fpu\n")
    with pytest.raises(ImportError, match="none of them"):
        folder(str(tmp_path), cpuinfo)


def installed(folder, *levels):
    """The script that runs programs, and a program for each level that says which one it is."""
    (folder / "bin").mkdir()
    shutil.copy(Path(__file__).parents[2] / "Tools/pendular", folder / "bin")
    for level in levels:
        program = folder / "lib/x86_64-linux-gnu/pendular" / level / "Say"
        program.parent.mkdir(parents=True)
        program.write_text(f'#!/bin/sh\necho "{level}" "$@"\n')
        program.chmod(0o755)

    def say(*words, level=""):
        done = subprocess.run([folder / "bin/pendular", *words], capture_output=True, text=True,
                              env={**os.environ, "PENDULAR_LEVEL": level})
        return done.stdout + done.stderr, done.returncode

    return say


@pytest.mark.skipif(not levels(), reason="this machine is no x86-64")
def test_programs_are_of_the_level_that_the_module_takes(tmp_path):
    """glibc's list of levels, which the script reads, is the one that is made of the processor's flags."""
    three = ["x86-64-v2", "x86-64-v3", "x86-64-v4"]
    say = installed(tmp_path, *three)
    assert say("Say", "a b", "--c") == (f"{levels()[0]} a b --c\n", 0)
    for level in three:
        assert say("Say", level=level) == (f"{level}\n", 0)
    assert say()[0].endswith("\nSay\n")
    assert "no program Nothing" in say("Nothing")[0]
    text, code = say("Say", level="x86-64-v9")
    assert code == 1 and text == "pendular: there are programs for x86-64-v2 x86-64-v3 x86-64-v4 only, and none for x86-64-v9.\n"


@pytest.mark.skipif(not levels(), reason="this machine is no x86-64")
def test_programs_of_a_lower_level(tmp_path):
    assert installed(tmp_path, "x86-64-v2")("Say") == ("x86-64-v2\n", 0)


def test_programs_of_one_build(tmp_path):
    say = installed(tmp_path, "")
    assert say("Say", "1") == (" 1\n", 0)


def public(value):
    return [getattr(value, name) for name in vars(value) if not name.startswith("_")]


@pytest.mark.parametrize("name", [n for n in dir(pendular.Scene) if not n.startswith("_")])
def test_everything_is_documented(name):
    """More than the signature that pybind11 writes."""
    text = getattr(pendular.Scene, name).__doc__ or ""
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith(f"{name}(")]
    assert lines, name


def functions():
    """Those of the package and of its classes, with the texts of attributes."""
    owners = [(pendular, pendular.__all__)]
    for name in ("Scene", "Wall", "Species", "Sizes", "Region", "Mixture"):
        of = getattr(pendular, name)
        owners.append((of, [n for n in dir(of) if not n.startswith("_")]))
    for owner, names in owners:
        for name in names:
            value = getattr(owner, name)
            if not isinstance(value, type):
                yield pytest.param(name, value, id=f"{owner.__name__}.{name}")


def arguments_of(name, value):
    """(names of arguments, text without the signature)."""
    if inspect.isfunction(value):
        return [n for n in inspect.signature(value).parameters if n != "self"], value.__doc__ or ""
    first, _, text = (value.__doc__ or "").partition("\n")
    if not first.startswith(f"{name}("):
        return [], value.__doc__ or ""
    return [n for n in re.findall(r"[(,] (?:\*, )?(\w+): ", first.replace("(", "( ", 1)) if n not in ("self", "arg0")], text


@pytest.mark.parametrize("name, value", functions())
def test_help_says_what_each_argument_is(name, value):
    """Its name is in the text, which has no word that means nothing in Python."""
    arguments, text = arguments_of(name, value)
    assert text.strip()
    for argument in arguments:
        assert re.search(rf"\b{argument}\b", text), f"{argument} is not in: {text}"
    assert not re.search(r"::|add_output|\bsolve\(|README of this|@param|\bstd\b|visit_state|fix_particle", text), text


def test_arguments_are_found():
    assert arguments_of("add_plane", pendular.Scene.add_plane)[0] == ["species", "outward", "point", "forces"]
    assert "follows_wall" in arguments_of("add_inlet", pendular.Scene.add_inlet)[0]


def test_names_are_those_of_python():
    """No name of the kernel is left in what help() says: they are in small letters."""
    for value in public(pendular.Scene):
        for word in re.findall(r"\b(?:set|get|add|keep|is|has)[A-Z]\w+", value.__doc__ or ""):
            pytest.fail(f"{word} in {value}")
