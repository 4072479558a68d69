"""Who may import whom: the rules of the architecture, read from the sources."""

import ast
import re
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

SOURCE = Path(__file__).parent.parent / "src" / "mechsheet"

EVERYBODY = {
    "diagnostics",
    "extras",
    "arguments.numbers",
    "said",
    "counted",
    "on_demand",
    "replacing",
    "time_limit",
}
ALLOWED = {
    "diagnostics": set(),
    "said": set(),
    "counted": set(),
    "on_demand": set(),
    "replacing": {"diagnostics", "said"},
    "time_limit": {"diagnostics", "said"},
    "extras": {"said"},
    "arguments": {"formula"},
    "units": set(),
    "portable": set(),
    "model": {"formula.nodes", "units"},
    "words": {"model"},
    "formula": {"portable"},
    # the nodes of expressions are data of the model; how they are parsed, printed and evaluated is not the reference's
    "reference": {"model", "formula.nodes"},
    "engine": {"formula", "portable"},
    # tasks and the steps of their solutions, as dimensions that follow from others
    "synthesis": {"portable", "model", "formula", "units", "words"},
    "description": {"portable", "model", "formula", "units", "synthesis"},
    "kinematics": {"portable", "model", "formula", "units", "words"},
    # forces, from what is solved already; kinematics knows nothing of them
    "dynamics": {"portable", "model", "formula", "kinematics", "units", "words"},
    "sheet": {"portable", "model", "formula", "kinematics", "synthesis", "units", "words"},
    # formats know the workbook as data (sheet/workbook.py), nothing of how it came about
    "formats": {"formula", "sheet.workbook"},
    # a mechanism compiled: its equations, their values in numpy, its workbook with the values that the engine computes
    "compiled": {"model", "formula", "kinematics", "dynamics", "sheet", "engine"},
    # what a mechanism looks like, once for all who draw it
    "shapes": {"portable", "model", "formula", "kinematics", "sheet", "compiled", "units", "words"},
    # plotting draws the list of shapes, and the curves of the workbook at positions that the engine computes
    "plotting": {
        "shapes",
        "units",
        "model",
        "words",
        "formula",
        "kinematics",
        "sheet",
        "compiled",
        "engine",
        "arguments",
    },
    # exporting prints the equations, draws the list of shapes, and tabulates their values
    "exporting": {
        "shapes",
        "portable",
        "model",
        "units",
        "words",
        "formula",
        "kinematics",
        "sheet",
        "compiled",
        "plotting",
        "arguments",
    },
}
# judging other people's workbooks: the engine recalculates them, the reference knows the truth
ALLOWED["exporting"] |= {"synthesis.writing"}
ALLOWED["homework"] = {
    "model",
    "units",
    "words",
    "formula",
    "description",
    "engine",
    "reference",
    # which numbers may be which dimensions is tried with the equations; what is found is proven by the reference
    "kinematics.solve",
    "kinematics.equations",
    "kinematics.numeric",
    "kinematics.sweep",
    # what a mean over the motion is
    "kinematics.means",
    # the figure of a task, drawn as the first sheet draws
    "shapes.positions",
    "sheet.drawing.drawing",
    "sheet.drawing.frames",
    "compiled",
    "formats",
    "sheet.workbook",
    "sheet.styles",
    "sheet.wrapping",
    # a task is told in the words of the workbook's notes, with the workbook's drawing
    "sheet.first.given",
    "sheet.mathematics",
    "plotting",
    "arguments",
    # the routines of the text's appendix are those that exports write
    "exporting.functions",
    "exporting.lambdas",
    "exporting.routines",
}
# designs by the thousand: the equations printed as numpy; what a summary is, and which loops there are, the sheet says;
# the axes of its picture are those of every curve
ALLOWED["studies"] = {
    "plotting.axes",
    "model",
    "formula",
    "description",
    "kinematics",
    "sheet",
    "compiled",
    "formats",
    "words",
    "__version__",
}
# the page shows what the library builds and what checking says of it
ALLOWED["drawing_page"] = {
    "model",
    "units",
    "words",
    "formula",
    "description",
    "kinematics",
    "compiled",
    "sheet.drawing.outlines",
    "shapes",
    "plotting",
    "checking",
    "library",
    "arguments",
}
PARTS = sorted(ALLOWED)
FORMATS = {name: {"", "reading", name} for name in ("xlsx", "ods", "xls")} | {
    "reading": {"reading"},
    "": {"", "reading"},
}
"""Folder of formats ("" for what lies beside them) -> the folders it may import: the formats are strangers."""


def modules_of(part: str) -> list[Path]:
    folder = SOURCE / part
    return sorted(folder.rglob("*.py")) if folder.is_dir() else [SOURCE / f"{part}.py"]


@cache
def imports(path: Path) -> set[tuple[int, str]]:
    """(line, module below mechsheet) of every import, also those inside functions."""
    package = ("mechsheet", *path.relative_to(SOURCE).with_suffix("").parts)
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = ".".join(package[: len(package) - node.level]) if node.level else ""
            module = ".".join(part for part in (base, node.module or "") if part)
            names = [module] if module != "mechsheet" else [f"mechsheet.{alias.name}" for alias in node.names]
        else:
            continue
        found |= {(node.lineno, name.removeprefix("mechsheet.")) for name in names if name.startswith("mechsheet.")}
    return found


def forbidden(part: str) -> list[str]:
    allowed = ALLOWED[part] | EVERYBODY | {part}
    wrong = []
    for path in modules_of(part):
        for line, module in sorted(imports(path)):
            if not any(module == name or module.startswith(f"{name}.") for name in allowed):
                wrong.append(f"{path.relative_to(SOURCE).as_posix()}:{line}: {part} may not import {module}")
    return wrong


@pytest.mark.parametrize("part", PARTS)
def test_part_imports_only_what_it_may(part):
    assert modules_of(part)
    assert forbidden(part) == []


@pytest.mark.parametrize("folder", FORMATS)
def test_folders_of_formats_import_downwards(folder):
    files = sorted((SOURCE / "formats" / folder).glob("*.py"))
    wrong = [
        f"{path.relative_to(SOURCE).as_posix()}:{line}: {module}"
        for path in files
        for line, module in sorted(imports(path))
        if module.startswith("formats.") and _folder_of_formats(module) not in FORMATS[folder]
    ]
    assert files
    assert wrong == []


def _folder_of_formats(module: str) -> str:
    name = module.split(".")[1]
    return name if (SOURCE / "formats" / name).is_dir() else ""


def test_every_folder_of_formats_has_a_rule():
    assert {path.parent.name for path in (SOURCE / "formats").glob("*/__init__.py")} == set(FORMATS) - {""}


def test_nobody_imports_the_command_line():
    for path in SOURCE.rglob("*.py"):
        if "cli" not in path.relative_to(SOURCE).parts and path.name != "__main__.py":
            assert not [line for line, module in imports(path) if module == "cli" or module.startswith("cli.")], path


def test_only_the_command_line_and_the_package_import_homework():
    for path in SOURCE.rglob("*.py"):
        if not {"homework", "cli"} & set(path.relative_to(SOURCE).parts) and path.name != "__init__.py":
            assert not [line for line, module in imports(path) if module.split(".")[0] == "homework"], path


def test_the_rule_can_fail():
    """The reader of imports sees what it should see."""
    seen = {module for _, module in imports(SOURCE / "checking" / "against_reference.py")}
    assert {"reference", "kinematics.sweep"} <= seen


def test_every_folder_has_a_rule():
    folders = {path.name for path in SOURCE.iterdir() if path.is_dir() and (path / "__init__.py").exists()}
    # checking is where all of them meet, the library and the command line offer everything
    assert folders <= set(ALLOWED) | {"checking", "cli", "library"}


@pytest.mark.parametrize("part", ["kinematics", "dynamics"])
def test_what_solves_a_mechanism_has_no_hidden_circles(part):
    """An import inside a function would be one: nothing there is loaded late for speed."""
    late = re.compile(r"^ +(?:from|import) mechsheet", re.MULTILINE)
    assert [path.name for path in modules_of(part) if late.search(path.read_text(encoding="utf-8"))] == []


SHEET = (
    # what cells, formulas and places are made of
    {"workbook", "styles", "symbols", "wrapping", "quoted", "addresses", "places", "degrees", "mathematics"},
    # which columns there are: the equations as cells compute them, before anything has a place
    {"columns"},
    # the plan, which gives everything its place, and what is said in formulas over these places alone
    {"classification", "task_rows", "plan", "driving", "over_rows", "shown", "cells", "transmission", "grashof"},
    # rows first, then what is measured and searched in rows, then what draws and judges by that
    {"table"},
    {"checks"},
    {"drawing"},
    {"synthesis"},
    # the first sheet says what all of these find; notes and tables asked for repeat it in words and for other dimensions
    {"first"},
    {"notes", "asked"},
    # a workbook, and all of it on one page
    {"constants", "layout"},
    {"page"},
)
"""Modules and folders of sheet/ from the bottom to the top: each imports from its own line and those above it here."""


def of_sheet(path):
    """The modules and folders of sheet/ that a module imports."""
    names = {module.split(".")[1] for _, module in imports(path) if module.startswith("sheet.")}
    return names - {path.relative_to(SOURCE / "sheet").with_suffix("").parts[0]}


def test_folders_of_sheet_import_downwards():
    rank = {name: number for number, names in enumerate(SHEET) for name in names}
    members, wrong = {}, []
    for path in modules_of("sheet"):
        own = path.relative_to(SOURCE / "sheet").with_suffix("").parts[0]
        if own != "__init__":
            members.setdefault(own, set()).update(of_sheet(path))
            wrong += [f"{path.name}: {name}" for name in of_sheet(path) if rank[name] > rank[own]]
    assert wrong == []
    assert members.keys() <= rank.keys()
    assert [*TopologicalSorter(members).static_order()]  # no circle within a line either: CycleError names it
