"""Workbooks that LibreOffice saved with cells it had not computed: said with what to press, and no alarm."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

from mechsheet.checking import check
from mechsheet.checking.programs import libreoffice_command
from mechsheet.cli import main

ROOT = Path(__file__).parent.parent.parent
GENERATED = ROOT / "generated"
PATIENCE = 120

MACRO = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE script:module PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "module.dtd">
<script:module xmlns:script="http://openoffice.org/2000/script" script:name="Runner" script:language="StarBasic">
Function Setting(key As String, content As Variant) As Object
    Dim made As New com.sun.star.beans.PropertyValue
    made.Name = key
    made.Value = content
    Setting = made
End Function

Sub Rename(folder As String)
    Dim document As Object
    document = StarDesktop.loadComponentFromURL(ConvertToURL(folder &amp; "/book.ods"), "_blank", 0, _
        Array(Setting("Hidden", True)))
    document.Sheets.getByIndex(1).setName("Renamed")
    document.storeToURL(ConvertToURL(folder &amp; "/renamed.ods"), Array(Setting("FilterName", "calc8")))
    document.storeToURL(ConvertToURL(folder &amp; "/renamed.xlsx"), _
        Array(Setting("FilterName", "Calc MS Excel 2007 XML")))
    document.calculateAll()
    document.storeToURL(ConvertToURL(folder &amp; "/computed.ods"), Array(Setting("FilterName", "calc8")))
    document.close(True)
    StarDesktop.terminate()
End Sub
</script:module>"""

LIBRARY = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE library:library PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "library.dtd">
<library:library xmlns:library="http://openoffice.org/2000/library" library:name="Standard" library:readonly="false"
 library:passwordprotected="false"><library:element library:name="Runner"/></library:library>"""


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """A built .ods with a sheet renamed in LibreOffice, which saves without computing what it had not shown yet."""
    folder = tmp_path_factory.mktemp("renamed")
    shutil.copy(GENERATED / "four-bar.ods", folder / "book.ods")
    profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
    command = [libreoffice_command(), profile, "--headless"]
    subprocess.run([*command, "--terminate_after_init"], check=True, timeout=PATIENCE, capture_output=True)
    standard = folder / "profile" / "user" / "basic" / "Standard"
    (standard / "script.xlb").write_text(LIBRARY, encoding="utf-8")
    (standard / "Runner.xba").write_text(MACRO, encoding="utf-8")
    macro = f"macro:///Standard.Runner.Rename({folder})"
    subprocess.run([*command, macro], check=True, timeout=PATIENCE, capture_output=True, env={**os.environ})
    return folder


@pytest.mark.libreoffice
@pytest.mark.slow
def test_cells_that_were_saved_uncomputed_are_said_with_what_to_press(saved):
    for name, command in (("renamed.ods", ["check", "-v"]), ("renamed.xlsx", ["recalc", "--check"])):
        report = check(saved / name)
        assert report.agrees and report.stored.uncomputed, name
        result = CliRunner().invoke(main, [*command, str(saved / name)])
        assert result.exit_code == 0
        assert "press Ctrl+Shift+F9, save it again" in result.output
        assert CliRunner().invoke(main, [*command, "--strict", str(saved / name)]).exit_code == 1
    report = check(saved / "computed.ods")
    assert report.agrees and not report.stored.uncomputed
