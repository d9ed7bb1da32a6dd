#!/usr/bin/env python3
"""Makes notebooks of the examples, so that nothing is written twice: a cell for each function, with the comments in front of it.

    make-notebooks.py FOLDER [EXAMPLE.py...]        default: all of Tools/Python/Examples
"""
import ast
import json
import re
import sys
from pathlib import Path


def cells_of(script):
    """(kind, text) of each cell. What starts with main() in the script is called without options in the notebook."""
    text = script.read_text()
    lines, parts = text.splitlines(), ast.parse(text).body
    words = ast.get_docstring(ast.parse(text))
    title, _, rest = words.partition("\n")
    usage = re.compile(rf"^    {re.escape(script.name)}.*\n?", re.M)
    yield "markdown", f"# {title}\n{usage.sub('', rest)}".strip()
    begin, pending = parts[0].end_lineno, []
    for part in parts[1:]:
        if isinstance(part, ast.If):  # if __name__ == "__main__"
            break
        isOwn = isinstance(part, (ast.FunctionDef, ast.ClassDef))
        if isOwn and pending:
            yield "code", "\n".join(pending).strip()
            pending = []
        pending += lines[begin:part.end_lineno]
        begin = part.end_lineno
        if isOwn:
            yield "code", "\n".join(pending).strip()
            pending = []
    if pending:
        yield "code", "\n".join(pending).strip()
    yield "code", "main([])"


def notebook_of(script):
    cells = []
    for number, (kind, text) in enumerate(cells_of(script)):
        cell = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": text.splitlines(keepends=True)}
        cells.append(cell if kind == "markdown" else {**cell, "execution_count": None, "outputs": []})
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}}, "nbformat": 4,
            "nbformat_minor": 5}


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: make-notebooks.py FOLDER [EXAMPLE.py...]")
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for script in map(Path, sys.argv[2:] or sorted((Path(__file__).parent / "Examples").glob("*.py"))):
        (folder / f"{script.stem}.ipynb").write_text(json.dumps(notebook_of(script), indent=1) + "\n")


if __name__ == "__main__":
    main()
