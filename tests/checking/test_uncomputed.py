"""Workbooks that LibreOffice saved with cells it had not computed, as 0: said with what to press, and no alarm."""

import re
import subprocess
import zipfile
from pathlib import Path

import pytest

from command_line import run
from mechsheet.checking import check
from mechsheet.checking.programs import libreoffice_command

pytestmark = pytest.mark.slow

FOUR_BAR = Path(__file__).parents[2] / "generated" / "four-bar.ods"
PATIENCE = 120
A_TEXT = {
    "ods": ("content.xml", r'(<table:table-cell [^>]*table:formula="[^"]*"[^>]*) office:value-type="string"[^>]*>',
            r'\1 office:value-type="float" office:value="0">'),
    "xlsx": ("xl/worksheets/sheet1.xml", r'(<c [^>]*?) t="str">(<f[^>]*>[^<]*</f>)<v>[^<]+</v>', r"\1>\2<v>0</v>"),
}  # fmt: skip
"""Where the first formula stands whose value is a text, and what LibreOffice has there before it computes it."""


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """A built workbook as LibreOffice saves it, in both formats; with the name `renamed` one cell is not computed."""
    folder = tmp_path_factory.mktemp("saved")
    for ending, (part, found, uncomputed) in A_TEXT.items():
        profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
        command = [libreoffice_command(), profile, "--headless", "--convert-to", ending, "--outdir", str(folder)]
        subprocess.run([*command, str(FOUR_BAR)], check=True, timeout=PATIENCE, capture_output=True)
        with (
            zipfile.ZipFile(folder / f"four-bar.{ending}") as whole,
            zipfile.ZipFile(folder / f"renamed.{ending}", "w") as damaged,
        ):
            for name in whole.namelist():
                text = whole.read(name)
                if name == part:
                    changed, count = re.subn(found, uncomputed, text.decode("utf-8"), count=1)
                    assert count == 1
                    text = changed.encode("utf-8")
                damaged.writestr(name, text)
    return folder


@pytest.mark.ci
@pytest.mark.libreoffice
def test_cells_that_were_saved_uncomputed_are_said_with_what_to_press(saved):
    for name, command in (("renamed.ods", ["check", "-v"]), ("renamed.xlsx", ["recalc", "--check"])):
        report = check(saved / name)
        assert report.agrees and report.stored.uncomputed, name
        result = run(*command, saved / name)
        assert result.exit_code == 0
        assert "press Ctrl+Shift+F9, save it again" in result.output
        assert run(*command, "--strict", saved / name).exit_code == 1
    report = check(saved / "four-bar.ods")
    assert report.agrees and not report.stored.uncomputed
