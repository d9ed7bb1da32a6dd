#!/usr/bin/env python3
"""Changes the #include lines of drivers to where the headers of the kernel are now.

    move-includes.py FILE...

moved-headers.tsv beside it has the old and the new place of each header. A file is written only if something in it changes.
"""
import pathlib
import re
import sys

TABLE = pathlib.Path(__file__).with_name("moved-headers.tsv")
INCLUDE = re.compile(r'^([ \t]*#[ \t]*include[ \t]*["<])(Kernel/[^">]+)', re.M)


def moved_headers():
    rows = (line.split("\t") for line in TABLE.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    return {old: new for old, new in rows}


def main(names):
    if names in (["-h"], ["--help"]):
        print(__doc__.strip())
        return
    if not names or any(name.startswith("-") for name in names):
        sys.exit("move-includes.py: it takes the files of drivers, and nothing else; see --help")
    moved = moved_headers()
    for name in names:
        try:
            text = pathlib.Path(name).read_bytes().decode("utf-8", "surrogateescape")
        except OSError as problem:
            sys.exit(f"move-includes.py: {name}: {problem.strerror}")
        changed = INCLUDE.sub(lambda found: found[1] + moved.get(found[2], found[2]), text)
        if changed != text:
            pathlib.Path(name).write_bytes(changed.encode("utf-8", "surrogateescape"))


if __name__ == "__main__":
    main(sys.argv[1:])
