#!/usr/bin/env python3
"""Which of MercuryDPM's public programs port, with how many lines: SelfTests/Mercury/programs.tsv, and the page beside it.

usage: mercury-programs.py [--list FILE] [--check] [--write]

Its columns: the program; the lines that change after port-from-mercury.sh ("-": it does not port); where that is from
(test: it is a test here; read: its source was read beside MercuryScene.h; list: the count of an earlier list); its tests;
what changes, or is missing. Lines are counted by hand, not compiled.
Prints the programs by class: few (below 10 lines), more, no.
  --list FILE  all of its programs (class, lines, program, what was missing): the table must have each that is not
               "internal" there; and prints how the classes have changed
  --check      the exit code is 1 if a row, a test or the page is wrong
  --write      writes the part of the page that follows from the table
"""
import argparse
import re
import sys
from collections import Counter
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "SelfTests" / "Mercury"
PAGE = FOLDER / "README.md"
BEGIN, END = "<!-- by Tools/mercury-programs.py --write -->\n", "<!-- until here -->\n"
CLASSES = ("few", "more", "no")


def table_of(path):
    head, *rows = path.read_text().splitlines()
    return [dict(zip(head.split("\t"), (row + "\t" * 4).split("\t"))) for row in rows]


def class_of(row):
    return "no" if row["lines"] == "-" else "few" if int(row["lines"]) < 10 else "more"


def faults_of(rows):
    tests = set(re.findall(r"TEST\(MercuryPrograms, (\w+)\)", "".join(p.read_text() for p in FOLDER.glob("*.cpp"))))
    for name, count in Counter(row["program"] for row in rows).items():
        if count > 1:
            yield f"{name} is there {count} times"
    for row in rows:
        if not re.fullmatch(r"-|\d+", row["lines"]) or row["from"] not in ("test", "read", "list"):
            yield f"{row['program']}: {row['lines']} lines from '{row['from']}'"
        if (row["from"] == "test") != bool(row["tests"]):
            yield f"{row['program']}: 'test' and tests do not fit each other"
        for test in set(row["tests"].split()) - tests:
            yield f"{row['program']}: there is no test {test}"


def part_of_page(rows):
    lines = [f"Of {len(rows)} programs that do not test MercuryDPM's own internals:", "",
             "| lines that change | programs | as tests here | source read | by an earlier list |", "|---|---|---|---|---|"]
    words = {"few": "below 10", "more": "10 and more", "no": "it does not port"}
    for name in CLASSES:
        counts = Counter(row["from"] for row in rows if class_of(row) == name)
        lines.append(f"| {words[name]} | {sum(counts.values())} | {counts['test']} | {counts['read']} | {counts['list']} |")
    for name, title in (("few", "Below 10 lines, without a test"), ("more", "10 lines and more"), ("no", "Not at all")):
        found = [row for row in rows if class_of(row) == name and (name != "few" or row["from"] != "test")]
        lines += ["", f"**{title}:**", ""]
        reasons = {}
        for row in found:
            reasons.setdefault(row["changed or missing"], []).append(row["program"])
        for reason, programs in sorted(reasons.items(), key=lambda pair: (pair[0] == "", pair[0].lower())):
            lines.append(f"- {', '.join(programs)}" + (f": {reason}" if reason else ""))
    return "\n".join(lines) + "\n"


def compare(rows, path):
    """Prints how classes have changed, and yields what the table lacks or has too much."""
    before = {row["program"]: row["class"] for row in table_of(path)}
    now = {row["program"]: class_of(row) for row in rows}
    outside = {name for name, kind in before.items() if kind != "internal"}
    for name in sorted(outside ^ set(now)):
        yield f"{name} is only in {'the list' if name in outside else 'the table'}"
    for (old, new), count in sorted(Counter((before[name], now[name]) for name in outside & set(now)).items()):
        print(f"{old} before, {new} now: {count}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    rows = table_of(FOLDER / "programs.tsv")
    faults = list(faults_of(rows))
    for name in CLASSES:
        print(f"{name}: {sum(class_of(row) == name for row in rows)} of {len(rows)}")
    if asked.list is None or not asked.list.is_file():
        print(f"SKIPPED: the table is not compared with a list of all programs: "
              f"{'no --list' if asked.list is None else f'no file {asked.list}'}.", file=sys.stderr)
    else:
        faults += compare(rows, asked.list)
    before, _, rest = PAGE.read_text().partition(BEGIN)
    _, _, after = rest.partition(END)
    whole = before + BEGIN + part_of_page(rows) + END + after
    if asked.write and not faults:
        PAGE.write_text(whole)
    if PAGE.read_text() != whole:
        faults.append(f"{PAGE.name} does not have what the table says; call --write")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if asked.check and faults else 0


if __name__ == "__main__":
    sys.exit(main())
