#!/usr/bin/env python3
r"""Counts what compiled functions move between 64-byte registers and their stack.

usage: count-stack-stores.py OBJECT_OR_PROGRAM TEXT [TEXT ...] [--at-most STORES] [--list]

Prints a row (CSV) for each part of each function whose demangled name contains every TEXT. The part "hot" is what
stands before the first return: g++ puts the branches that it takes for rare, and calls of functions marked cold,
behind it. The part "all" is the whole function.
  stores      moves from a 64-byte register to the stack
  loads       reads of the stack into such a register, operands of arithmetic included
  never_read  places with a store in this part that no instruction of the whole function reads; one whose address is
              handed to another function may be read there, so this is an upper bound
  vector      instructions with a 64-byte register, for scale
--list also prints the places that are never read. With --at-most the exit code is 1 if the hot part of a function has
more stores, and 77 if no function is found or none uses such registers (a machine without AVX-512).

Why: g++ 12 keeps a const struct, array or structured binding of packs that an inlined function returns in memory, at
one store for each pack (Kernel/Foundation/Math/Pack.h). The kernel of grain with grain and with walls, in a build of g++:
  count-stack-stores.py libPendularKernel.a 'ContactKernel<' 'computeBlock<' \
      'HertzianViscoelastic, pendular::Mindlin, pendular::NoAdhesion'
"""
import argparse
import re
import subprocess
import sys

SLOT = re.compile(r"(-?0x[0-9a-f]+)?\(%(rsp|rbp)\)")
MOVE = re.compile(r"vmov(?:[au]p[ds]|dq[au](?:8|16|32|64)?|ntp[ds]|ntdq)$")
NOT_FOUND = 77


def functions(path, texts):
    """Yields the name and the instructions (mnemonic, operands) of each function that is asked for."""
    command = ["objdump", "-dC", "--no-show-raw-insn", path]
    name, instructions = "", []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            if line.endswith(">:\n"):
                if instructions:
                    yield name, instructions
                name, instructions = line[line.index("<") + 1 : -3], []
                wanted = "[clone .cold" not in name and all(text in name for text in texts)
            elif "\t" in line and name and wanted:
                mnemonic, _, operands = line.split("\t")[1].strip().partition(" ")
                instructions.append((mnemonic, operands.strip()))
    if process.returncode != 0:
        sys.exit(f"objdump cannot read {path}.")
    if instructions:
        yield name, instructions


def traffic(instructions):
    """How often the stack is stored to and loaded from, vector instructions, and the places stored and read."""
    stored, read = set(), set()
    stores = loads = vector = 0
    for mnemonic, operands in instructions:
        vector += "zmm" in operands
        slot = SLOT.search(operands)
        if not slot:
            continue
        place = (slot[2], int(slot[1] or "0", 16))
        if MOVE.match(mnemonic) and operands.endswith(")"):
            if "zmm" in operands:
                stores += 1
                stored.add(place)
        else:
            loads += "zmm" in operands
            read.add(place)
    return stores, loads, vector, stored, read


def report(name, instructions, listed):
    """Prints the rows of a function; returns the stores of its hot part, and whether it uses vectors."""
    end = next((k for k, (mnemonic, _) in enumerate(instructions) if mnemonic.startswith("ret")), None)
    read = traffic(instructions)[4]
    counted = {}
    for part, chosen in ("hot", instructions[:end]), ("all", instructions):
        stores, loads, vector, stored, _ = traffic(chosen)
        never = [s for s in stored if not any(r[0] == s[0] and s[1] <= r[1] < s[1] + 64 for r in read)]
        print(f'{part},{stores},{loads},{len(never)},{vector},"{name}"')
        if listed:
            print("   ", " ".join(f"{offset:#x}({base})" for base, offset in sorted(never)))
        counted[part] = stores, vector
    return counted["hot"][0], counted["all"][1] > 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", metavar="OBJECT_OR_PROGRAM")
    parser.add_argument("texts", metavar="TEXT", nargs="+")
    parser.add_argument("--at-most", metavar="STORES", type=int)
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()

    print("part,stores,loads,never_read,vector,function")
    rows = [report(name, code, options.list) for name, code in functions(options.path, options.texts)]
    if options.at_most is None:
        return
    if not any(vectors for _, vectors in rows):
        print("No function of these names uses 64-byte registers.", file=sys.stderr)
        sys.exit(NOT_FOUND)
    most = max(stores for stores, _ in rows)
    if most > options.at_most:
        sys.exit(f"{most} stores to the stack, {options.at_most} are allowed. Is there a const pack? See "
                 "Kernel/Foundation/Math/Pack.h.")


if __name__ == "__main__":
    main()
