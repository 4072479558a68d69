"""Where files go and what is never overwritten: names, folders, links, devices, somebody's changes."""

import os
import shutil
import threading
import zipfile
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from small import CRANK

import mechsheet
from chosen import part
from command_line import run
from degenerate_cases import cases
from livesheet.formats import read
from livesheet.formats.archive import is_untouched
from mechsheet.compiled import Compiled
from mechsheet.description.templates import template_text

posix = pytest.mark.skipif(os.name == "nt", reason="Windows has no such files")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The same description built in both formats, once."""
    folder = tmp_path_factory.mktemp("made")
    (folder / "mine.toml").write_text(CRANK, encoding="utf-8")
    result = run("build", folder / "mine.toml", "-o", folder, "--format", "xlsx,ods")
    assert result.exit_code == 0, result.output
    return folder


@pytest.fixture
def here(made, tmp_path, monkeypatch):
    """A folder of one's own with the description and its workbooks in it."""
    for path in made.iterdir():
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.slow
def test_a_workbook_is_called_as_its_description(here):
    assert names(here) == ["mine.ods", "mine.toml", "mine.xlsx"]
    for name in ("mine.xlsx", "mine.ods"):
        assert mechsheet.recalc(name).as_dict()["Mechanism"]["A1"] == "Yoke at θ", "the title stays the mechanism's"


@pytest.mark.slow
def test_standard_input_has_the_mechanisms_name(here):
    assert run("build", "-", text=CRANK).stdout == "yoke.xlsx\n"


def test_the_ending_of_a_file_is_its_format(here):
    assert run("build", "mine.toml", "-o", "other.ods").stdout == "other.ods\n"
    assert (here / "other.ods").read_bytes() == (here / "mine.ods").read_bytes()


@pytest.mark.parametrize("name", ["new/", "new", "old", "old/"])
def test_folders(here, name):
    (here / "old").mkdir()
    assert run("build", "mine.toml", "-o", name).stdout == f"{name.rstrip('/')}/mine.xlsx\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "file"),
    [
        (("plot", "mine.toml"), "mine.svg"),
        (("export", "mine.toml", "--to", "csv"), "mine.csv"),
        (("export", "mine.toml", "--to", "svg"), "mine-drawing.svg"),
        (("recalc", "mine.xlsx"), "mine.xlsx"),
        (("pull", "mine.xlsx"), "mine.toml"),
        (("new", "scotch-yoke"), "scotch-yoke.toml"),
        (("schema",), "mechsheet.schema.json"),
    ],
    ids=lambda part: " ".join(part) if isinstance(part, tuple) else part,
)
def test_a_slash_means_a_folder_everywhere(here, arguments, file):
    result = run(*arguments, "-o", "out/")
    assert result.exit_code == 0, result.output
    assert names(here / "out") == [file]
    (here / "out" / file).unlink()
    assert run(*arguments, "-o", here / "out").exit_code == 0, "and so does an existing folder"
    assert names(here / "out") == [file]


def test_a_folder_made_for_nothing_goes_again(here):
    assert run("plot", "mine.toml", "--at", "nan", "-o", "out/").exit_code == 2
    assert run("build", "mine.toml", "-o", "nowhere/deeper/").exit_code == 2
    assert names(here) == ["mine.ods", "mine.toml", "mine.xlsx"]


def test_two_descriptions_never_write_one_file(here):
    (here / "sub").mkdir()
    shutil.copy("mine.toml", "sub/Mine.toml")
    for options in ([], ["-o", "out/"], ["-o", "one.xlsx"]):
        result = run("build", "mine.toml", "sub/Mine.toml", *options)
        assert result.exit_code == 2
        assert "mine.toml" in result.stderr and "sub/Mine.toml" in result.stderr
    assert "Mine.xlsx" not in names(here) and "out" not in names(here)


@pytest.mark.slow
def test_one_description_named_twice_is_one(here):
    assert run("build", "mine.toml", here / "mine.toml").stdout == "mine.xlsx\n"


def test_an_input_is_never_overwritten(here):
    for arguments in (
        ("export", "mine.toml", "--to", "csv", "-o", "mine.toml"),
        ("build", "mine.toml", "-o", "mine.toml", "--force"),
        ("recalc", "mine.xlsx", "-o", "./"),
        ("pull", "mine.xlsx", "-o", "mine.xlsx"),
    ):
        assert run(*arguments).exit_code == 2, arguments
    assert (here / "mine.toml").read_text(encoding="utf-8") == CRANK


@pytest.mark.slow
def test_plot_and_export_do_not_share_a_name(here):
    drawn, written = run("plot", "mine.toml").stdout, run("export", "mine.toml", "--to", "svg").stdout
    assert drawn != written


# --- somebody's changes --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_older_build_is_written_over(here):
    before = (here / "mine.xlsx").read_bytes()
    assert is_untouched(here / "mine.xlsx") and is_untouched(here / "mine.ods")
    assert run("build", "mine.toml", "--set", "a2=31").exit_code == 0
    assert (here / "mine.xlsx").read_bytes() != before
    assert run("build", "mine.toml").exit_code == 0
    assert (here / "mine.xlsx").read_bytes() == before, "deterministic"


def rezipped(path):
    """As a program saves: the same parts, one sheet with another number, all else about the zip file as it was."""
    with zipfile.ZipFile(path) as archive:
        parts = [(entry, archive.read(entry)) for entry in archive.infolist()]
    with zipfile.ZipFile(path, "w") as archive:
        for entry, data in parts:
            archive.writestr(entry, data.replace(b">30<", b">33<").replace(b'"30"', b'"33"'))


CHANGES = {
    "recalculated": lambda path: run("recalc", path, "--set", "a2=33", "-o", path),
    "saved": rezipped,
    "not ours": lambda path: path.write_text("homework"),
    "half": lambda path: path.write_bytes(path.read_bytes()[:5000]),
}


@pytest.mark.parametrize(
    ("kind", "suffix"), part([(kind, suffix) for suffix in ("xlsx", "ods") for kind in CHANGES], of=3, turn=1)
)
def test_changes_are_not_overwritten(here, kind, suffix):
    path = here / f"mine.{suffix}"
    CHANGES[kind](path)
    held = path.read_bytes()
    result = run("build", "mine.toml", "--format", "xlsx,ods")
    assert result.exit_code == 2 and "--force" in result.stderr and path.name in result.stderr
    assert path.read_bytes() == held
    with pytest.raises(mechsheet.MechsheetError, match="is not as build wrote it"):
        mechsheet.load("mine.toml").build(".", suffix)


def test_force_overwrites(here):
    held = (here / "mine.xlsx").read_bytes()
    (here / "mine.xlsx").write_text("homework")
    assert run("build", "mine.toml", "--force").exit_code == 0
    assert (here / "mine.xlsx").read_bytes() == held


def test_an_empty_file_holds_nobodys_work(here):
    (here / "empty.xlsx").touch()
    assert run("build", "mine.toml", "-o", "empty.xlsx").exit_code == 0


# --- links and devices ---------------------------------------------------------------------------------------------


@posix
def test_a_link_stays_a_link(here):
    (here / "shelf").mkdir()
    target = (here / "shelf" / "target.csv").absolute()
    link = here / "link.csv"
    link.symlink_to(target)  # what it leads to is not there yet
    for _ in range(2):
        assert run("export", "mine.toml", "--to", "csv", "-o", "link.csv").exit_code == 0
        assert link.is_symlink() and target.read_text().startswith("theta")
    assert names(here / "shelf") == ["target.csv"]
    loop = here / "loop.csv"
    loop.symlink_to(loop)
    result = run("export", "mine.toml", "--to", "csv", "-o", "loop.csv")
    assert result.exit_code == 2 and "round" in result.stderr and loop.is_symlink()


@posix
def test_pipes_are_written_through(here):
    os.mkfifo("pipe")
    got = []
    reader = threading.Thread(target=lambda: got.append(Path("pipe").read_bytes()))
    reader.start()
    result = run("build", "mine.toml", "-o", "pipe", "--format", "ods")
    reader.join(60)
    assert result.exit_code == 0 and result.stdout == ""
    assert got == [(here / "mine.ods").read_bytes()]
    assert not Path("pipe").is_file()


@posix
def test_devices_are_written_through(here):
    before = Path("/dev/null").stat()
    assert run("build", "mine.toml", "-o", "/dev/null").exit_code == 0
    assert Path("/dev/null").stat().st_rdev == before.st_rdev
    result = run("export", "mine.toml", "--to", "csv", "-o", "/dev/full")
    assert result.exit_code == 2 and "/dev/full" in result.stderr and "full" in result.stderr


# --- pull and new --------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('name = "yoke"', 'name = "pump"', '"pump"'),
        ("[links.crank]", "[links.disc]", '"crank"'),
        ('on = "yoke"\npoint = "A"\nthrough = "P"', 'on = "yoke"\npoint = "A"\nthrough = [0, 0]', ""),
    ],
)
def test_pull_refuses_another_mechanism(here, old, new, said):
    run("recalc", "mine.xlsx", "--set", "a2=33", "-o", "changed.xlsx")
    text = CRANK.replace(old, new).replace('link = "crank"', 'link = "disc"' if "disc" in new else 'link = "crank"')
    (here / "other.toml").write_text(text, encoding="utf-8")
    result = run("pull", "changed.xlsx", "--into", "other.toml")
    if said:
        assert result.exit_code == 2 and said in result.stderr and "other.toml" in result.stderr
    else:
        assert result.exit_code == 0 and "a2 = 33" in result.stdout


def test_new_names_no_schema_that_is_not_there(here):
    assert run("new", "scotch-yoke", "-o", "a.toml").exit_code == 0
    assert "#:schema" not in (here / "a.toml").read_text(encoding="utf-8")
    assert "#:schema" not in run("new", "scotch-yoke").stdout
    run("schema", "-o", "mechsheet.schema.json")
    run("new", "scotch-yoke", "-o", "b.toml")
    first, _, rest = (here / "b.toml").read_text(encoding="utf-8").partition("\n")
    assert first == "#:schema mechsheet.schema.json" and (here / first.split()[1]).exists()
    assert rest == (here / "a.toml").read_text(encoding="utf-8")


@pytest.mark.slow
def test_new_lists_titles():
    lines = run("new", "--list").stdout.splitlines()
    assert ["four-bar", "Four-bar", "linkage"] in [line.split() for line in lines]
    assert all(len(line.split(None, 1)) == 2 for line in lines)


# --- the verdict ---------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ((), "closes in all 25 positions; A0ABB0: crank-rocker, crank can turn fully; transmission angle"),
        (("a2=50",), "closes in 22 / 25 positions; A0ABB0: triple rocker"),
        (("step", "35"), "the step misses the stop (360°): the last row is 350°"),
        (("step", "14.99999"), "the step misses the stop (360°): the last row is 359.9998°"),
        (("step", "15.0000001"), "the step misses the stop (360°): the last row is 345.000002°"),
    ],
)
def test_one_line_says_whether_it_closes(tmp_path, settings, said):
    from mechsheet.library.verdicts import verdict

    text = template_text("four-bar")
    overrides = {}
    if settings[:1] == ("step",):
        text = text.replace("step = 15", f"step = {settings[1]}")
    elif settings:
        overrides = dict(setting.split("=") for setting in settings)
    mechanism = mechsheet.loads(text, "four-bar.toml", overrides)
    assert said in verdict(Compiled(mechanism))


@pytest.mark.parametrize(
    ("language", "said"),
    [
        ("en", "; undetermined in 2 positions, the first at 60°: rod1 and rod2: pins A, B, P"),
        ("tr", "; 2 konumda belirsiz, ilki 60°: rod1 ve rod2: A, B, P mafsalları"),
    ],
)
def test_the_line_says_where_links_are_free_to_turn(language, said):
    from mechsheet.library.verdicts import verdict

    case = next(case for case in cases("degenerate") if case.name == "coaxial-cranks")
    assert verdict(Compiled(mechsheet.loads(case.description, language=language))).endswith(said)


@pytest.mark.slow
def test_build_prints_the_verdict_beside_the_names(here):
    result = run("build", "mine.toml")
    assert result.stdout == "mine.xlsx\n", "names only: they can be piped"
    line = read(Path("mine.xlsx")).sheets[0].cached.get(1, 0)
    assert result.stderr == f"mine.toml: {line}\n", "the line of the first sheet"
    assert "closes in all 5 positions" in result.stderr
    assert result.stderr.removeprefix("mine.toml: ") in run("show", "mine.toml").stdout


# --- numbers given to the library ----------------------------------------------------------------------------------

LENGTHS = [
    31,
    31.0,
    np.float64(31),
    np.float32(31),
    np.int16(31),
    np.array(31.0),
    Fraction(62, 2),
    Decimal("31.0"),
    "31",
]


@pytest.mark.parametrize("value", LENGTHS, ids=lambda value: type(value).__name__)
def test_every_number_is_a_number(value):
    linkage = mechsheet.loads(CRANK, overrides={"a2": value})
    assert [dimension.value for dimension in linkage.dimensions] == [31.0]


@pytest.mark.parametrize(
    "value",
    [True, np.True_, None, [31], np.array([31.0]), "31,5", "", float("nan"), Decimal("inf"), 10**400, 3j, b"31"],
)
def test_what_is_no_number_is_refused_in_the_words_of_the_library(value):
    with pytest.raises(mechsheet.MechsheetError, match="number") as found:
        mechsheet.loads(CRANK, overrides={"a2": value})
    assert "a2" in str(found.value) and "--set" not in str(found.value)


def test_arguments_are_refused_in_the_words_of_the_library(tmp_path):
    linkage = mechsheet.loads(CRANK)
    for call, key in (
        (lambda: linkage.plot(tmp_path / "a.svg", at="5"), "at"),
        (lambda: linkage.plot(tmp_path / "a.svg", at=True), "at"),
        (lambda: linkage.plot(tmp_path / "a.svg", language="de"), "language"),
        (lambda: mechsheet.export(linkage, "svg", tmp_path / "a.svg", at="5"), "at"),
        (lambda: mechsheet.export(linkage, "svg", tmp_path / "a", frames=2.5), "frames"),
        (lambda: mechsheet.export(linkage, "pdf", tmp_path / "a"), "to"),
        (lambda: linkage.build(tmp_path, "xls"), "formats"),
        (lambda: linkage.build(tmp_path, ["xlsx", 3]), "formats"),
        (lambda: linkage.build(tmp_path, 5), "formats"),
        (lambda: linkage.build(tmp_path / "a.xlsx", ["xlsx", "ods"]), "formats"),
        (lambda: mechsheet.loads(CRANK, overrides="a2=3"), "overrides"),
    ):
        with pytest.raises(mechsheet.MechsheetError) as found:
            call()
        assert key in str(found.value).split(": ") and " --" not in str(found.value)
    assert names(tmp_path) == []
    assert [path.name for path in linkage.build(tmp_path, "xlsx")] == ["yoke.xlsx"], "one format as a plain text"
