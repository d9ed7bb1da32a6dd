#!/usr/bin/env python3
"""Which of MercuryDPM's public programs port, with how many lines: SelfTests/Mercury/programs.tsv, and the page beside it.

usage: mercury-programs.py [--list FILE] [--table FILE] [--check] [--write]

Its columns: the program; the lines that change after port-from-mercury.sh ("-": it does not run here); where that is from
(test: it is a test here; run: it was ported, compiled and run by hand; read: its source was read beside MercuryScene.h;
list: the count of an earlier list); whether the whole program was run, and its figures compared; its tests; what changes,
or is missing. The fourth column is "yes: FIGURE, by REFERENCE", "in part: WHAT", or "no", with a reason after a colon. A
program whose test is, by the page, another scene was not run.
Only rows with "yes" count as ports; the lines of "read" and "list" were counted by hand, and the program was never run.
Prints the programs by class (few: below 10 lines; more; no), and how many of each were run whole.
  --list FILE  all of its programs (class, lines, program, what was missing): the table must have each that is not
               "internal" there; and prints how the classes have changed
  --table FILE another table than SelfTests/Mercury/programs.tsv
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
RUN = "run whole, figures compared"
# What a figure may be compared with: a stored file, asserted values, a formula, an integration, the program there.
REFERENCES = r"(its|the) \.\w+|its source|a closed form|its steps written anew|brute force|a run of MercuryDPM"


def table_of(path):
    head, *rows = path.read_text().splitlines()
    return [dict(zip(head.split("\t"), (row + "\t" * 5).split("\t"))) for row in rows]


def class_of(row):
    return "no" if row["lines"] == "-" else "few" if int(row["lines"]) < 10 else "more"


def ran(row):
    """How much of the program was run: yes, in part, or no."""
    return row[RUN].partition(":")[0]


def fault_of_run(row):
    """What is wrong with the column of the run, if anything."""
    kind, _, rest = row[RUN].partition(": ")
    if kind not in ("yes", "in part", "no") or (":" in row[RUN]) != bool(rest):
        return f"'{row[RUN]}' is not 'yes: ...', 'in part: ...', 'no' or 'no: ...'"
    if kind == "in part" and not rest:
        return "'in part' does not say of what"
    if kind == "yes" and not re.fullmatch(rf".+, by ({REFERENCES})( .*|, .*)?", rest):
        return f"'{row[RUN]}' lacks a figure, or what it was compared with"
    if kind != "no" and (row["lines"] == "-" or row["from"] not in ("test", "run")):
        return f"it has '{kind}', but {row['lines']} lines from '{row['from']}'"
    if kind == "no" and row["from"] == "test" and not rest:
        return "it is a test, and has 'no' without a reason"
    return None


def in_another_scene(page):
    """The programs whose tests are, by the page's table of tests, in a scene of our own."""
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) == 8 and cells[4].startswith("another scene"):
            yield from cells[1].split(", ")


def faults_of(rows, page):
    other_scenes = set(in_another_scene(page))
    tests = set(re.findall(r"TEST\(MercuryPrograms, (\w+)\)", "".join(p.read_text() for p in FOLDER.glob("*.cpp"))))
    for name, count in Counter(row["program"] for row in rows).items():
        if count > 1:
            yield f"{name} is there {count} times"
    for row in rows:
        if not re.fullmatch(r"-|\d+", row["lines"]) or row["from"] not in ("test", "run", "read", "list"):
            yield f"{row['program']}: {row['lines']} lines from '{row['from']}'"
        if (row["from"] == "test") != bool(row["tests"]):
            yield f"{row['program']}: 'test' and tests do not fit each other"
        if fault := fault_of_run(row):
            yield f"{row['program']}: {fault}"
        elif ran(row) != "no" and row["program"] in other_scenes:
            yield f"{row['program']}: it has '{ran(row)}', but its test is another scene"
        for test in set(row["tests"].split()) - tests:
            yield f"{row['program']}: there is no test {test}"


def by_reason(rows):
    """Lines of the page: programs with the same reason together, those without one last."""
    reasons = {}
    for row in rows:
        reasons.setdefault(row["changed or missing"], []).append(row["program"])
    for reason, programs in sorted(reasons.items(), key=lambda pair: (pair[0] == "", pair[0].lower())):
        yield f"- {', '.join(programs)}" + (f": {reason}" if reason else "")


def part_of_page(rows):
    of = {name: [row for row in rows if class_of(row) == name] for name in CLASSES}
    counts = {name: Counter(ran(row) for row in of[name]) for name in CLASSES}
    few, no = counts["few"], len(of["no"])
    lines = [f"Of {len(rows)} programs that do not test MercuryDPM's own internals, **{few['yes']} port with fewer than 10 lines: they",
             f"were run whole, and their figures compared.** The others do not count as ports: of {few['in part']} more below 10 lines",
             f"a part was run or compared, another {few['no']} were counted by hand, and not run. **{no} do not run here at all.**", "",
             "| lines that change | programs | run whole, figures compared | in part | not run |", "|---|---|---|---|---|"]
    words = {"few": "below 10", "more": "10 and more", "no": "it does not run here"}
    for name in CLASSES:
        lines.append(f"| {words[name]} | {len(of[name])} | {counts[name]['yes']} | {counts[name]['in part']} | {counts[name]['no']} |")
    lines += ["", "**Run whole, figures compared** (in brackets the lines that change):", ""]
    lines += [f"- {row['program']} ({row['lines']}): {row[RUN].partition(': ')[2]}" for row in rows if ran(row) == "yes"]
    lines += ["", "**In part, outside of the tests above:**", ""]
    lines += [f"- {row['program']} ({row['lines']}): {row[RUN].partition(': ')[2]}"
              for row in rows if ran(row) == "in part" and row["from"] == "run"]
    for title, found in (("Below 10 lines, counted by hand, not run", [row for row in of["few"] if ran(row) == "no"]),
                         ("10 lines and more", of["more"]), ("Not at all", of["no"])):
        lines += ["", f"**{title}:**", "", *by_reason(found)]
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
    parser.add_argument("--table", type=Path, default=FOLDER / "programs.tsv")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    rows = table_of(asked.table)
    page = PAGE.read_text()
    faults = list(faults_of(rows, page))
    for name in CLASSES:
        found = [row for row in rows if class_of(row) == name]
        print(f"{name}: {len(found)} of {len(rows)}, {sum(ran(row) == 'yes' for row in found)} run whole with figures compared")
    if asked.list is None or not asked.list.is_file():
        print(f"SKIPPED: the table is not compared with a list of all programs: "
              f"{'no --list' if asked.list is None else f'no file {asked.list}'}.", file=sys.stderr)
    else:
        faults += compare(rows, asked.list)
    before, _, rest = page.partition(BEGIN)
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
