#!/usr/bin/env python3
"""Takes what help() says from the comments of the kernel's headers, so that it is written once.

    make-comments.py OUTPUT.cpp KERNEL_FOLDER BINDING.cpp...

For each comment("Class::function") or comment("Class", ...) in the bindings it finds the declaration, and the /// comment in
front of it. It fails where there is none.
"""
import re
import sys
from pathlib import Path


def snake(name):
    return re.sub(r"(?<=[a-z0-9])([A-Z])", r"_\1", name).lower()


# What a comment says for drivers in C++, and for those in Python.
WORDS = [
    (r"Given to Simulation::add_output\(\), which then keeps", "It keeps"),
    (r"Given to Simulation::add_output\(\); the", "The"),
    (r" ?Given to Simulation::add_output\(\)[.;]?", ""),
    (r" \((?:see )?(?:the )?README of this folder\)|; see the README of this folder", ""),
    (r" \(MembraneNet\.h\)| \(Insertion\.h\)|, and in visit_state\(\)", ""),
    (r"\b(?:solve|run_to|run_steps)\(\)", "run()"),
    (r"\bfinish_run\(\)", "finish()"),
    (r"\bshear_flow_at\(\)", "flow_at()"),
    (r"With all axes it is fix_particle\(\)", "'all' holds it altogether"),
    (r"\bfix_particle\(\)", "fixed=True"),
    (r"\bset_time_step\(\)", "time_step"),
    (r"\bEnergyLedger::lost\(\)", "what is lost in energy()"),
    (r"Throws as get_force\(\)", "Raises as force"),
    (r"\bread_grain_file\(\) reads", "add_grains_of_file() reads"),
    (r"\b[A-Z]\w+::(?=[a-z_]+\(\))", ""),
]


def in_python(text):
    """Names of functions and fields as they are in Python; lines as they flow."""
    text = re.sub(r"@param (\w+)", lambda m: f"\n{snake(m[1])}:", text)
    text = re.sub(r"\b([a-z]{2,}(?:[A-Z][a-z0-9]*)+)\b", lambda m: snake(m[1]), text)
    text = re.sub(r"\bset_(\w+)\(\)", r"set_\1()", text).replace("Throws InputError", "Raises InputError")
    for pattern, by in WORDS:
        text = re.sub(pattern, by, text)
    return re.sub(r" *\n *", "\n", re.sub(r"[ \t]+", " ", text)).strip()


def comments_of(header):
    """{name or Class::name: comment} of a header; the first declaration of a name that has one."""
    found, classes, comment, depth = {}, [], [], 0
    for line in header.read_text().splitlines():
        code = line.strip()
        if code.startswith("///"):
            comment.append(code[3:].strip())
            continue
        if code.startswith("//") or re.fullmatch(r"template.*>|(?:class|struct) \w+;", code):
            continue  # the comment is of what follows
        own = code.partition("///<")[0]
        named = re.match(r"(?:class|struct|enum class|using) (\w+)", own)
        function = None if named else re.search(r"(\w+)\(", own)
        name = (named or function)[1] if (named or function) else None
        if name and comment:
            whole = "::".join([c for c, _ in classes] + [name])
            found.setdefault(whole, " ".join(comment))
        trailing = re.search(r"// (.+)$", own)
        if function and not comment and trailing:
            found.setdefault("::".join([c for c, _ in classes] + [name]), trailing[1])
        if named and "{" in own:
            classes.append((name, depth))
        own = re.sub(r"//.*$", "", own)
        depth += own.count("{") - own.count("}")
        while classes and depth <= classes[-1][1] and "}" in own:
            classes.pop()
        if code:
            comment = []
    return found


def main():
    output, kernel, *bindings = map(Path, sys.argv[1:])
    wanted = sorted({n for b in bindings for n in re.findall(r'comment\(\s*"([\w:]+)"', b.read_text())})
    known = {}
    for header in sorted(kernel.rglob("*.h")):
        if header.name == "MercuryScene.h" or (header.parent.name == "Mercury" and header.name != "MercuryOutput.h"):
            continue
        for name, text in comments_of(header).items():
            known.setdefault(name, text)
    missing = [name for name in wanted if name not in known]
    if missing:
        sys.exit(f"make-comments.py: no comment in {kernel} at {', '.join(missing)}.")
    # Who reads help() has no source at hand: pages are named by what they are about.
    paths = [name for name in wanted if re.search(r"\b(?:Kernel|Tools|Drivers|SelfTests)/", known[name])]
    if paths:
        sys.exit(f"make-comments.py: help() would name a path of the repository at {', '.join(paths)}.")
    rows = "".join(f'    {{"{n}", R"~({in_python(known[n])})~"}},\n' for n in wanted)
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(
        "// Written by make-comments.py from the headers of the kernel.\n#include <map>\n#include <string_view>\n\n"
        "namespace pendular::python {\n\nconst char* comment(std::string_view name) {\n"
        "    static const std::map<std::string_view, const char*> comments = {\n"
        f"{rows}    }};\n    return comments.at(name);\n}}\n\n}}  // namespace pendular::python\n"
    )


if __name__ == "__main__":
    main()
