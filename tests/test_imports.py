"""Who may import whom: the rules of the architecture, read from the sources."""

import ast
import re
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

SOURCE = Path(__file__).parent.parent / "src" / "mechsheet"
LIBRARY = SOURCE.with_name("livesheet")

EVERYBODY = {
    "diagnostics",
    "livesheet.diagnostics",
    "extras",
    "arguments.values",
    "livesheet.said",
    "livesheet.on_demand",
    "livesheet.replacing",
    "livesheet.time_limit",
}
ALLOWED = {
    "diagnostics": set(),
    "extras": set(),
    "arguments": {"livesheet.formula"},
    "units": set(),
    "model": {"livesheet.formula", "units"},
    "words": {"model"},
    # the nodes of expressions are data of the model; how they are parsed, printed and evaluated is not the reference's
    "reference": {"model", "livesheet.formula.nodes"},
    # tasks and the steps of their solutions, as dimensions that follow from others
    "synthesis": {"livesheet.portable", "model", "livesheet.formula", "units", "words"},
    "description": {"livesheet.portable", "model", "livesheet.formula", "units", "synthesis", "words.catalogue"},
    "kinematics": {"livesheet.portable", "model", "livesheet.formula", "units", "words"},
    # forces, from what is solved already; kinematics knows nothing of them
    "dynamics": {"livesheet.portable", "model", "livesheet.formula", "kinematics", "units", "words"},
    # what a mechanism looks like, once for all who draw it
    "shapes": {"livesheet.portable", "model", "livesheet.formula", "kinematics", "units", "words"},
    "sheet": {
        "livesheet.portable",
        "livesheet.workbook",
        "livesheet.evaluation",
        "model",
        "livesheet.formula",
        "kinematics",
        "shapes",
        "synthesis",
        "units",
        "words",
    },
    # a mechanism compiled: its equations, their values in numpy, its workbook with the values that the engine computes
    "compiled": {
        "units",
        "model",
        "livesheet.formula",
        "kinematics",
        "dynamics",
        "sheet",
        "livesheet.workbook",
        "livesheet.evaluation",
        "livesheet.engine",
    },
    # plotting draws the list of shapes, and the curves of the workbook at positions that the engine computes
    "plotting": {
        "shapes",
        "units",
        "model",
        "words",
        "livesheet.formula",
        "kinematics",
        "sheet",
        "livesheet.workbook",
        "livesheet.evaluation",
        "compiled",
        "livesheet.engine",
        "arguments",
    },
    # exporting prints the equations, draws the list of shapes, and tabulates their values
    "exporting": {
        "shapes",
        "livesheet.portable",
        "model",
        "units",
        "words",
        "livesheet.formula",
        "kinematics",
        "sheet",
        "livesheet.workbook",
        "livesheet.evaluation",
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
    "livesheet.formula",
    "description",
    "livesheet.engine",
    "reference",
    # which numbers may be which dimensions is tried with the equations; what is found is proven by the reference
    "kinematics.solve",
    "kinematics.equations",
    "kinematics.numeric",
    "kinematics.sweep",
    # what a mean over the motion is
    "kinematics.whole_turns",
    # the figure of a task, drawn as the first sheet draws
    "shapes.positions",
    "shapes.names",
    "shapes.colors",
    "sheet.drawing.drawing",
    "sheet.drawing.frames",
    "compiled",
    "livesheet.formats",
    "livesheet.workbook",
    "livesheet.evaluation",
    "sheet.styles",
    "sheet.cells",
    # a task is told in the words of the workbook's notes, with the workbook's drawing
    "sheet.shown",
    "sheet.mathematics",
    "plotting",
    "arguments",
    # the functions of the text's appendix, and those of a module of Basic
    "library.routines",
}
# designs by the thousand: the equations printed as numpy; what a summary is, and which loops there are, the sheet says;
# the axes of its picture are those of every curve
ALLOWED["studies"] = {
    "plotting.axes",
    "model",
    "livesheet.formula",
    "description",
    "kinematics",
    "sheet",
    "livesheet.workbook",
    "livesheet.evaluation",
    "compiled",
    "livesheet.formats",
    "words",
    "version",
}
# the page shows what the library builds and what checking says of it
ALLOWED["drawing_page"] = {
    "model",
    "units",
    "words",
    "livesheet.formula",
    "description",
    "kinematics",
    "compiled",
    "shapes",
    "plotting",
    "checking",
    "library",
    "arguments",
}
PARTS = sorted(ALLOWED)
IN_LIBRARY = {
    "said": set(),
    "on_demand": set(),
    "diagnostics": {"said"},
    "replacing": {"said", "diagnostics"},
    "time_limit": {"said", "diagnostics"},
    "portable": set(),
    "formula": {"said", "diagnostics", "portable"},
    # a workbook as data: no file format is known here, and formats know nothing else of what they write
    "workbook": {"formula"},
    "formats": {"said", "diagnostics", "on_demand", "replacing", "time_limit", "formula", "workbook"},
    "engine": {"said", "diagnostics", "on_demand", "time_limit", "formula", "portable"},
    # macros as formulas: what they mean is the engine's
    "basic": {"said", "diagnostics", "formula"},
    "evaluation": {"diagnostics", "formula", "workbook", "engine"},
}
"""Part of livesheet -> the parts that it may import."""
FORMATS = {name: {"", "reading", name} for name in ("xlsx", "ods", "xls")} | {
    "reading": {"reading"},
    "": {"", "reading"},
}
"""Folder of formats ("" for what lies beside them) -> the folders it may import: the formats are strangers."""


def modules_of(part: str, package: Path = SOURCE) -> list[Path]:
    folder = package / part
    return sorted(folder.rglob("*.py")) if folder.is_dir() else [package / f"{part}.py"]


@cache
def imports(path: Path) -> set[tuple[int, str]]:
    """(line, module) of every import of the project's own, also those inside functions; mechsheet's without its name."""
    package = path.relative_to(SOURCE.parent).with_suffix("").parts
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = ".".join(package[: len(package) - node.level]) if node.level else ""
            module = ".".join(part for part in (base, node.module or "") if part)
            whole = module in ("mechsheet", "livesheet")
            names = [f"{module}.{alias.name}" for alias in node.names] if whole else [module]
        else:
            continue
        own = (name for name in names if name.startswith(("mechsheet.", "livesheet.")))
        found |= {(node.lineno, name.removeprefix("mechsheet.")) for name in own}
    return found


def forbidden(part: str, package: Path, allowed: set[str]) -> list[str]:
    wrong = []
    for path in modules_of(part, package):
        for line, module in sorted(imports(path)):
            if not any(module == name or module.startswith(f"{name}.") for name in allowed):
                wrong.append(f"{path.relative_to(package).as_posix()}:{line}: {part} may not import {module}")
    return wrong


@pytest.mark.cases(5)
@pytest.mark.parametrize("part", PARTS)
def test_part_imports_only_what_it_may(part):
    assert modules_of(part)
    assert forbidden(part, SOURCE, ALLOWED[part] | EVERYBODY | {part}) == []


@pytest.mark.parametrize("part", sorted(IN_LIBRARY))
def test_part_of_the_library_imports_only_what_it_may(part):
    """Nothing of mechanisms above all: who uses livesheet alone needs no mechsheet."""
    assert modules_of(part, LIBRARY)
    assert forbidden(part, LIBRARY, {f"livesheet.{name}" for name in IN_LIBRARY[part] | {part}}) == []


@pytest.mark.parametrize("folder", FORMATS)
def test_folders_of_formats_import_downwards(folder):
    files = sorted((LIBRARY / "formats" / folder).glob("*.py"))
    wrong = [
        f"{path.relative_to(LIBRARY).as_posix()}:{line}: {module}"
        for path in files
        for line, module in sorted(imports(path))
        if module.startswith("livesheet.formats.") and _folder_of_formats(module) not in FORMATS[folder]
    ]
    assert files
    assert wrong == []


def _folder_of_formats(module: str) -> str:
    name = module.split(".")[2]
    return name if (LIBRARY / "formats" / name).is_dir() else ""


def test_every_folder_of_formats_has_a_rule():
    assert {path.parent.name for path in (LIBRARY / "formats").glob("*/__init__.py")} == set(FORMATS) - {""}


@pytest.mark.slow
def test_nobody_imports_the_command_line():
    for path in SOURCE.rglob("*.py"):
        if "cli" not in path.relative_to(SOURCE).parts and path.name != "__main__.py":
            assert not [line for line, module in imports(path) if module == "cli" or module.startswith("cli.")], path


@pytest.mark.slow
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
    parts = {path.stem for path in LIBRARY.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    assert parts == {*IN_LIBRARY, "__init__"}
    # checking is where all of them meet, the library and the command line offer everything
    assert folders <= set(ALLOWED) | {"checking", "cli", "library"}


@pytest.mark.parametrize("part", ["kinematics", "dynamics"])
def test_what_solves_a_mechanism_has_no_hidden_circles(part):
    """An import inside a function would be one: nothing there is loaded late for speed."""
    late = re.compile(r"^ +(?:from|import) mechsheet", re.MULTILINE)
    assert [path.name for path in modules_of(part) if late.search(path.read_text(encoding="utf-8"))] == []


SHEET = (
    # what cells, formulas and places are made of
    {"styles", "printing", "quoted", "addresses", "places", "as_typed"},
    # which columns there are: the equations as cells compute them, before anything has a place
    {"columns"},
    # the plan, which gives everything its place, and what is said in formulas over these places alone
    {
        "classification",
        "task_rows",
        "plan",
        "driving",
        "over_rows",
        "deleted",
        "shown",
        "cells",
        "mathematics",
        "transmission",
        "geometry",
        "grashof",
        "inputs",
    },
    # rows first, then what is measured and searched in rows, then what draws and judges by that
    {"table"},
    {"checks"},
    {"drawing"},
    {"synthesis"},
    # what can be said of the motion, of what all of these find
    {"findings"},
    # the first sheet says it; notes and tables asked for repeat it in words and for other dimensions
    {"first"},
    {"notes", "asked"},
    # everything gets its place
    {"planning"},
    # a workbook, and all of it on one page
    {"layout"},
    {"page"},
)
"""Modules and folders of sheet/ from the bottom to the top: each imports from its own line and those above it here."""


def of_sheet(path):
    """The modules and folders of sheet/ that a module imports."""
    names = {module.split(".")[1] for _, module in imports(path) if module.startswith("sheet.")}
    return names - {path.relative_to(SOURCE / "sheet").with_suffix("").parts[0]}


@pytest.mark.slow
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


def circle_in(sources):
    """Modules that import each other in a ring, [] if none do; module -> its text, that of a package ends in __init__.

    Every import counts, wherever it stands: inside functions, and of types alone.
    """
    arrows = {}
    for name, text in sources.items():
        named = set()
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                named |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                base = name.split(".")[: -node.level] if node.level else []
                module = ".".join([*base, *filter(None, [node.module])])
                below = {f"{module}.{alias.name}" for alias in node.names}
                named |= {one if {one, f"{one}.__init__"} & sources.keys() else module for one in below}
        found = {one if one in sources else f"{one}.__init__" for one in named} & sources.keys()
        arrows[name] = found - {name}
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as circle:
        return circle.args[1]
    return []


def test_no_modules_import_each_other_in_a_circle():
    files = [*SOURCE.rglob("*.py"), *LIBRARY.rglob("*.py")]
    named = {".".join(path.relative_to(SOURCE.parent).with_suffix("").parts): path for path in files}
    assert circle_in({name: path.read_text(encoding="utf-8") for name, path in named.items()}) == []


@pytest.mark.parametrize(
    "upwards",
    [
        "from ..a import one",
        "def late():\n    from p.a import one",
        "if TYPE_CHECKING:\n    from p import a",
        "import p.a",
    ],
)
def test_a_circle_is_found_wherever_its_imports_stand(upwards):
    sources = {"p.__init__": "", "p.a": "from p.q import b", "p.q.__init__": "", "p.q.b": upwards}
    assert {"p.a", "p.q.b"} == set(circle_in(sources))
    assert circle_in(sources | {"p.q.b": "from p import c"}) == []
