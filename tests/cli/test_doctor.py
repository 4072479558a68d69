"""`mechsheet doctor` on machines that have everything, or nothing."""

import json
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

from command_line import run
from mechsheet.checking import programs
from mechsheet.cli import doctor
from mechsheet.extras import EXTRAS


@pytest.mark.slow
def test_names_what_is_there_with_its_version():
    result = run("doctor")
    assert result.exit_code == 0
    assert "agrees with its numpy reference" in result.stdout
    there = result.stdout.partition("\nMissing")[0]
    assert "matplotlib 3." in there


def nothing(package):
    raise metadata.PackageNotFoundError(package)


def test_says_how_to_get_what_is_missing(monkeypatch):
    monkeypatch.setattr(metadata, "version", nothing)
    monkeypatch.setattr(doctor.shutil, "which", lambda name: None)
    monkeypatch.setattr(programs, "LIBREOFFICE_PLACES", ())
    monkeypatch.setattr(sys, "platform", "win32")
    parts = {part.name: part for part in doctor.installed()}
    assert not any(part.found for part in parts.values())
    assert parts["mechsheet[plot]"].get == 'py -m pip install "mechsheet[plot]"'
    assert parts["LibreOffice"].get.startswith("winget install")
    assert "gnumeric" not in parts  # nobody offers it for Windows
    assert not doctor.on_path()


def test_finds_libreoffice_where_the_installer_puts_it(monkeypatch, tmp_path):
    place = tmp_path / "soffice.exe"
    place.write_text("")
    monkeypatch.setattr(programs.shutil, "which", lambda name: None)
    monkeypatch.setattr(programs, "LIBREOFFICE_PLACES", (str(tmp_path / "elsewhere"), str(place)))
    assert programs.libreoffice_command() == str(place)


@pytest.mark.slow
def test_json():
    found = json.loads(run("doctor", "--json").stdout)
    assert found["works"] is True
    assert {"mechsheet", "python", "system", "command", "parts"} <= set(found)


def test_extras_are_those_of_the_package():
    project = tomllib.loads((Path(__file__).parent.parent.parent / "pyproject.toml").read_text())["project"]
    wanted = {
        extra: {entry.partition(">")[0] for entry in entries}
        for extra, entries in project["optional-dependencies"].items()
        if extra != "test"
    }
    assert wanted == {extra: set(packages) for extra, (packages, _) in EXTRAS.items()}
