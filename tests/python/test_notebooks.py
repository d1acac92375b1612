"""The notebooks run from their first cell to their last, and say what their stored outputs say."""

import pathlib

import nbformat
import pytest
from nbconvert.preprocessors import ExecutePreprocessor

FOLDER = pathlib.Path(__file__).parents[2] / "tools" / "python" / "notebooks"


def printed(notebook):
    """What each cell prints."""
    return [
        "".join(output["text"] for output in cell.outputs if output.output_type == "stream")
        for cell in notebook.cells
        if cell.cell_type == "code"
    ]


# Recorded: `python3 -m nbconvert --to notebook --execute --inplace tools/python/notebooks/*.ipynb`,
# with the built module on the PYTHONPATH, stores the outputs anew.
@pytest.mark.parametrize("name", ["textbook", "homework", "which_filter", "your_own_data"])
def test_a_notebook_runs_and_its_outputs_are_current(name):
    notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    stored = printed(notebook)
    ExecutePreprocessor(timeout=600).preprocess(notebook, {"metadata": {"path": str(FOLDER)}})
    assert printed(notebook) == stored
    assert sum(len(str(cell.get("outputs", ""))) for cell in notebook.cells) < 300_000
