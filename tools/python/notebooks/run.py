"""Runs notebooks and compares what their cells give with the outputs that are kept in them.

run.py [--write] FILE.ipynb..

--write keeps the new outputs instead. Cells run in one namespace, as in Jupyter, which is not needed:
what a cell prints, the value of its last expression and figures of matplotlib are its outputs. Text is
compared word by word; pictures have to be there, and HTML and LaTeX beside a text are not compared.
"""

import ast
import base64
import contextlib
import difflib
import io
import json
import sys
from pathlib import Path


def value_output(value):
    """What a notebook keeps of the value of a cell."""
    data = {"text/plain": repr(value).splitlines(keepends=True)}
    for kind, name in (("text/html", "_repr_html_"), ("text/latex", "_repr_latex_")):
        made = getattr(value, name, lambda: None)()
        if made is not None:
            data[kind] = made.splitlines(keepends=True)
    return {"output_type": "execute_result", "data": data, "metadata": {}, "execution_count": None}


def figures():
    """The open figures of matplotlib, which are closed."""
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is None:
        return
    for number in pyplot.get_fignums():
        file = io.BytesIO()
        pyplot.figure(number).savefig(file, format="png", dpi=80, bbox_inches="tight", metadata={"Software": None})
        picture = base64.b64encode(file.getvalue()).decode()
        yield {"output_type": "display_data", "data": {"image/png": picture, "text/plain": ["<figure>"]}, "metadata": {}}
    pyplot.close("all")


def run_cell(source, names, place):
    """The outputs of a cell."""
    tree = ast.parse(source, place)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    value = None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, place, "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), place, "eval"), names)
    drawn = list(figures())
    outputs = []
    if printed.getvalue():
        text = printed.getvalue().splitlines(keepends=True)
        outputs.append({"output_type": "stream", "name": "stdout", "text": text})
    if value is not None and not drawn:  # the value of a cell that draws is the artist
        outputs.append(value_output(value))
    return outputs + drawn


def words(outputs):
    """What is compared."""
    return [(one["output_type"], "".join(one.get("text") or one["data"]["text/plain"])) for one in outputs]


def run(path, write):
    """Whether the outputs are those that were kept."""
    notebook = json.loads(path.read_text())
    names = {"__name__": "__main__"}
    same = True
    for number, cell in enumerate(notebook["cells"], 1):
        if cell["cell_type"] != "code":
            continue
        place = f"{path.name}, cell {number}"
        outputs = run_cell("".join(cell["source"]), names, place)
        kept, now = words(cell["outputs"]), words(outputs)
        if write:
            # A picture that differs by what a library rounds is no news.
            if kept != now or "image/png" not in str(outputs):
                cell["outputs"] = outputs
        elif kept != now:
            same = False
            lines = difflib.unified_diff("\n".join(text for _, text in kept).splitlines(),
                                         "\n".join(text for _, text in now).splitlines(), "kept", "now", lineterm="")
            print(f"{place}:", *lines, sep="\n")
    if write:
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")
    return same


def main(arguments):
    write = "--write" in arguments
    with contextlib.suppress(ImportError):
        import matplotlib

        matplotlib.use("Agg")
    results = [run(Path(name), write) for name in arguments if name != "--write"]
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
