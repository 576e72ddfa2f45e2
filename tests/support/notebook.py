"""Notebooks executed with the standard library: cells in, outputs out, as nbformat 4 has them.

`python -m tests.support.notebook docs/notebook.ipynb` writes the outputs into the file again.
"""

import ast
import json
import os
import sys
from base64 import b64encode
from contextlib import chdir, redirect_stdout
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

RICH = {"text/html": "_repr_html_", "image/png": "_repr_png_"}


def cells(path):
    """The cells of a notebook."""
    return json.loads(Path(path).read_text("utf-8"))["cells"]


def executed(code_cells):
    """The outputs of each of these cells, run one after another in the current folder."""
    names = {}
    return [_outputs("".join(cell["source"]), names) for cell in code_cells]


def _outputs(source, names):
    """Output of a cell, then the value of its last expression, if it ends in one."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = StringIO()
    with redirect_stdout(printed):
        exec(compile(tree, "<cell>", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names) if last else None
    outputs = []
    if text := printed.getvalue():
        outputs.append({"name": "stdout", "output_type": "stream", "text": _lines(text)})
    if value is not None:
        outputs.append({"data": _shown(value), "metadata": {}, "output_type": "display_data"})
    return outputs


def _shown(value):
    """A value by the kinds of text and pictures in which it shows itself."""
    data = {"text/plain": _lines(repr(value))}
    for kind, method in RICH.items():
        shown = getattr(value, method)() if hasattr(value, method) else None
        if shown:
            picture = isinstance(shown, bytes)
            data[kind] = b64encode(shown).decode() if picture else _lines(shown)
    return data


def _lines(text):
    return text.splitlines(keepends=True)


def main(path):
    """Execute a notebook in a folder of its own, and write its outputs."""
    notebook = json.loads(Path(path).read_text("utf-8"))
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    with TemporaryDirectory() as folder, chdir(folder):
        for number, (cell, outputs) in enumerate(zip(code, executed(code), strict=True), 1):
            cell |= {"outputs": outputs, "execution_count": number}
    Path(path).write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", "utf-8")


if __name__ == "__main__":
    os.environ["MPLBACKEND"] = "Agg"
    main(sys.argv[1])
