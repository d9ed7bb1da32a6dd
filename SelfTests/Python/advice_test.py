"""What the pages advise is what the module, the examples and the drivers do by default.

A kind of advice (the law, the step, warnings) has one page that states it, with a table of the programs that do otherwise and why.
The tests below read the page, and compare it with the other pages, with the module, and with the sources of all programs.
"""
import csv
import math
import re
import warnings
from pathlib import Path

import pytest

import pendular
from conftest import GLASS, tower

ROOT = Path(__file__).parents[2]
DRIVERS, EXAMPLES = ROOT / "Drivers", ROOT / "Tools/Python/Examples"


def page(name):
    """Its text without the targets of links, each run of blanks and ends of lines as one blank."""
    return " ".join(re.sub(r"\]\([^)]*\)", "]", (ROOT / name).read_text()).split())


def rows_below(name, heading):
    """The first two columns of the table below a heading of a page, without backquotes around the first."""
    text = (ROOT / name).read_text().partition(f"\n{heading}\n")[2].partition("\n#")[0]
    rows = re.findall(r"^\| `([^|]*)` \| ([^|]*) \|", text, flags=re.M)
    assert rows, f"{name} has no table below {heading}"
    return dict(rows)


def drivers():
    return sorted(folder.name for folder in DRIVERS.iterdir() if (folder / f"{folder.name}.cpp").exists())


def sources_of(driver):
    """The text of a driver, with all that it includes of Drivers/."""
    seen, files = {}, list((DRIVERS / driver).glob("*.cpp"))
    while files:
        file = files.pop()
        if file in seen:
            continue
        seen[file] = file.read_text()
        for name in re.findall(r'^#include "(Drivers/[^"]*)"', seen[file], flags=re.M):
            files += [found for found in (ROOT / name, (ROOT / name).with_suffix(".cpp")) if found.exists()]
    return "\n".join(seen.values())


def examples():
    return {file.name: file.read_text() for file in sorted(EXAMPLES.rglob("*.py"))}


def snippets(name):
    """The code of a page, but that of superquadrics and blocks, whose scenes are compiled for few species."""
    code = re.findall(r"```(?:cpp|python)\n(.*?)```", (ROOT / name).read_text(), flags=re.S)
    return [text for text in code if not re.search("superquadric", text, flags=re.I)]


# The law -------------------------------------------------------------------------------------------------------------

LAWS = "Kernel/Laws/README.md"  # has the start
FRICTION = "Kernel/Laws/Friction/README.md"  # has the rule
EXCEPTIONS = "### Programs that take `Mindlin`"
# Laws of MercuryDPM on Hertz' force, as the name of a species or as a type; not MindlinIncremental and MindlinPartialSlip.
OTHER = re.compile(r"\bHertzianViscoelasticMindlin(?!Incremental|PartialSlip)|\bSpecies<HertzianViscoelastic, Mindlin(?:Secant|RollingTorsion)?[,>]")
FOLLOWING = re.compile(r"\bHertzianViscoelasticMindlin(?:Incremental|PartialSlip)")


def advised():
    """Normal, tangential and bridge law that the page says to start with."""
    return re.search(r"Start with `(\w+)` and `(\w+)`, for wet grains with `(\w+)`", page(LAWS)).groups()


def test_the_advised_law_can_be_had():
    normal, tangential, bridge = advised()
    wanted = {f"{normal}{tangential}{end}" for end in ("", bridge, "LiquidBridgeBagheri", "RollingTorsion")}
    assert wanted <= set(pendular.species())
    for name in sorted(wanted):
        assert pendular.Scene().add_species(name).name == name


@pytest.mark.parametrize("name", [FRICTION, LAWS, "Kernel/HOW-DO-I.md", "Tools/Python/HOW-DO-I.md"])
def test_pages_say_one_thing_of_the_law(name):
    text, (_, tangential, _) = page(name), advised()
    assert re.search(f"(?i)(take|start with `\\w+` and) `{tangential}`", text)
    rule = re.search(r"(?i)`Mindlin`[^.]*(?:results of MercuryDPM)[^.]*where only bulk quantities count", text)
    assert rule, f"{name} does not say when to take Mindlin"


def test_drivers_follow_the_advice_on_the_law():
    others = {name for name in drivers() if OTHER.search(sources_of(name))}
    assert others == {row.partition("/")[2] for row in rows_below(FRICTION, EXCEPTIONS) if row.startswith("Drivers/")}
    assert {"WetTower", "SiloFilling", "WornPlates"} <= {name for name in drivers() if FOLLOWING.search(sources_of(name))}


def test_examples_follow_the_advice_on_the_law():
    folder = "Tools/Python/Examples/"
    others = {name for name, text in examples().items() if OTHER.search(text)}
    assert others == {row.removeprefix(folder) for row in rows_below(FRICTION, EXCEPTIONS) if row.startswith(folder)}
    assert len([name for name, text in examples().items() if FOLLOWING.search(text)]) > 3


@pytest.mark.parametrize("name", ["README.md", "Tools/Python/README.md", "Kernel/HOW-DO-I.md", "Tools/Python/HOW-DO-I.md"])
def test_snippets_follow_the_advice_on_the_law(name):
    assert not [text for text in snippets(name) if OTHER.search(text)]
    assert [text for text in snippets(name) if FOLLOWING.search(text)]


def test_exceptions_have_a_reason():
    """By the rule: another's results, or a bulk quantity that alone counts."""
    for program, reason in rows_below(FRICTION, EXCEPTIONS).items():
        assert re.search(r"reproduces|only the .* counts?$|beside other programs", reason), program
        assert (ROOT / program).exists() or (ROOT / f"{program}.cpp").exists(), program


# The step ------------------------------------------------------------------------------------------------------------

MOTION = "Kernel/Core/Motion/README.md"
OTHER_STEPS = "### Examples that take another step"
IN_CPP = r"setTimeStep\(std::min\(stabilityLimit\(\), shortestContactTime\(\) / (\d+)\)\)"
IN_PYTHON = r"time_step = min\(scene\.stability_limit\(\), scene\.shortest_contact_time\(\) / (\d+)\)"
OF_ANOTHER_LENGTH = re.compile(r"\.time_step = |choose_time_step\([^)]|set_step_for\(")


def advised_steps_in_contact():
    return int(re.search(rf"For most scenes.*?{IN_CPP}", (ROOT / MOTION).read_text(), flags=re.S)[1])


@pytest.mark.parametrize("name, form", [("Kernel/HOW-DO-I.md", IN_CPP), ("Tools/Python/HOW-DO-I.md", IN_PYTHON), ("README.md", IN_CPP)])
def test_pages_say_one_thing_of_the_step(name, form):
    text = (ROOT / name).read_text()
    if name != "README.md":
        text = text.partition("### Choose the time step\n")[2].partition("\n### ")[0]
    assert int(re.search(form, text)[1]) == advised_steps_in_contact()


@pytest.mark.parametrize("restitution, byContact", [(0.9, True), (0.1, False)])  # dashpots take the limit below that
def test_the_module_takes_the_advised_step(restitution, byContact):
    scene = tower()
    scene.glass.set(restitution_coefficient=restitution)
    limit, part = scene.stability_limit(), scene.shortest_contact_time() / advised_steps_in_contact()
    assert (part < limit) == byContact
    assert scene.choose_time_step() == scene.time_step == min(limit, part)


def test_examples_follow_the_advice_on_the_step():
    folder = "Tools/Python/Examples/"
    others = {name for name, text in examples().items() if OF_ANOTHER_LENGTH.search(text)}
    assert others == {row.removeprefix(folder) for row in rows_below(MOTION, OTHER_STEPS)}
    assert len([name for name, text in examples().items() if ".choose_time_step()" in text]) > 4


def without_a_reason(call):
    """Lines of drivers with a call that have no comment, at their ends or above."""
    found = []
    for file in [*DRIVERS.rglob("*.cpp"), *DRIVERS.rglob("*.h")]:
        lines = file.read_text().splitlines()
        found += [f"{file.name}: {line.strip()}" for before, line in zip([""] + lines, lines)
                  if call in line and "//" not in line and not before.strip().startswith("//")]
    return found


def test_drivers_above_the_stability_limit_say_why():
    """All others are refused by the kernel, if their step is above it."""
    assert not without_a_reason("acceptUnstableTimeStep()")


# The runs of each column of the table, by their restitution and step over Rayleigh's time.
RUNS = [{("0.5", "0.15")}, {("0.5", "0.272"), ("0.9", "0.272"), ("0.2", "0.128"), ("0.5", "0.3")},
        {("0.5", "0.4"), ("0.9", "0.4"), ("0.2", "0.19"), ("0.1", "0.146")}]
QUANTITIES = {"SolidFraction": {("bed", "solid_fraction"), ("hopper", "flow_kg/s")}, "ContactsAtRest": {("bed", "coordination")},
              "ContactsInFlow": {("drum", "coordination"), ("impact", "coordination")},
              "Friction": {("drum", "centre_angle_deg"), ("drum", "surface_angle_deg")}, "Fluctuations": {("drum", "kinetic_energy_J")}}


def rounded_up(percent):
    """to two digits"""
    return math.ceil(10 * percent - 1e-9) / 10 if percent < 10 else float(math.ceil(percent))


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_the_errors_of_a_bulk_quantity_are_those_of_the_runs(quantity):
    """The mean deviation with two standard errors, the largest of the scenes and all shorter steps, on the page and in the kernel."""
    lines = [line for line in (ROOT / "Tools/Studies/Results/bulk-steps.csv").read_text().splitlines() if not line.startswith("#")]
    largest, found = 0.0, []
    for runs in RUNS:
        for row in csv.DictReader(lines):
            if ((row["restitution"], row["step_over_rayleigh_time_or_share"]) in runs
                    and (row["scene"], row["figure"]) in QUANTITIES[quantity]):
                largest = max(largest, abs(float(row["deviation_percent"])) + 2 * float(row["deviation_standard_error_percent"]))
        found.append(rounded_up(largest))
    stated = re.search(rf"^\| `{quantity}`[^|]*\|(.*)\|$", (ROOT / MOTION).read_text(), flags=re.M)[1].replace("%", "")
    assert [float(cell) for cell in stated.split("|")] == found
    source = (ROOT / "Kernel/Scene/TimeStep/StepForFigure.cpp").read_text()
    in_kernel = re.search(rf"WantedFigure::{quantity}, (?:true|false), {{([^}}]*)}}", source)[1]
    assert [float(cell) for cell in in_kernel.split(",")] == pytest.approx([percent / 100 for percent in found])


# Warnings ------------------------------------------------------------------------------------------------------------


def test_pages_say_that_warnings_come_by_default():
    assert "Warnings are printed once each" in page("Kernel/HOW-DO-I.md")
    assert "What a scene warns of is a `pendular.SceneWarning`, once each" in page("Tools/Python/HOW-DO-I.md")


def test_the_module_warns_by_default():
    scene = pendular.Scene()
    glass = scene.add_species("HertzianViscoelasticMindlin", **dict(GLASS, density=2.5))
    scene.add_grains(glass, [[0, 0, 0]], 1e-3)
    scene.choose_time_step()
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        scene.run(steps=2)
        scene.run(steps=2)
    assert [one.category for one in found] == [pendular.SceneWarning]


def test_examples_and_snippets_are_not_quiet():
    texts = examples() | {name: "".join(snippets(name)) for name in ("README.md", "Tools/Python/README.md", "Kernel/HOW-DO-I.md",
                                                                     "Tools/Python/HOW-DO-I.md")}
    assert not [name for name, text in texts.items() if re.search(r"quiet ?= ?True|setQuiet\(\)", text)]


def test_drivers_are_quiet_where_they_are_asked_to_be():
    assert "bool quiet = false;" in (DRIVERS / "Shared/RunOptions.h").read_text()
    assert not without_a_reason("setQuiet()")
