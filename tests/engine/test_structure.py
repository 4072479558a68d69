"""Folders of the engine: who imports whom, from the bottom up; only the two halves of the evaluator import each other."""

import ast

import pytest

from test_imports import LIBRARY, imports

ENGINE = LIBRARY / "engine"
EVALUATOR = {"interpreter", "kernels"}
BELOW = ["values", "texts", "layout", "graph", "results", "interpreter", "kernels", "resolve", "fast", "ordering"]
"""Each may import those before it."""


def _room(module):
    """The folder, or the module that lies flat, of `livesheet.engine.fast.lowering`."""
    return module.split(".")[2]


def _only_for_types(path):
    """Lines of imports under `if TYPE_CHECKING`."""
    blocks = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.If)]
    return {
        part.lineno
        for block in blocks
        if isinstance(block.test, ast.Name) and block.test.id == "TYPE_CHECKING"
        for part in block.body
    }


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize("room", BELOW)
def test_imports_go_down(room):
    allowed = {*BELOW[: BELOW.index(room) + 1], *(EVALUATOR if room in EVALUATOR else ())}
    files = sorted((ENGINE / room).rglob("*.py")) if (ENGINE / room).is_dir() else [ENGINE / f"{room}.py"]
    wrong = [
        f"{path.relative_to(ENGINE).as_posix()}:{line}: {module}"
        for path in files
        for line, module in sorted(imports(path))
        if module.startswith("livesheet.engine.") and line not in _only_for_types(path) and _room(module) not in allowed
    ]
    assert files
    assert wrong == []


def test_every_room_is_ranked():
    rooms = {path.stem for path in ENGINE.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    assert rooms - set(BELOW) == {"__init__", "plan", "incremental"}
