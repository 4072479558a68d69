"""The schema for editors: made from the reader's own, accepts what the reader accepts, refuses faults of keys."""

import json
import tomllib

import jsonschema
import pytest

from command_line import run
from folders import ROOT, TEMPLATE_FILES
from mechsheet.description.json_schema import FILE, json_schema, json_schema_text

JUDGE = jsonschema.Draft202012Validator(json_schema())

FAULTS_OF_KEYS = (ROOT / "tests" / "cases" / "faults_of_keys.txt").read_text(encoding="utf-8").split()
"""Cases of tests/errors whose fault is one of keys and kinds, not of names or numbers."""


def test_it_is_a_schema():
    jsonschema.Draft202012Validator.check_schema(json_schema())


def test_the_file_beside_the_templates_is_up_to_date():
    assert (ROOT / "templates" / FILE).read_text(encoding="utf-8") == json_schema_text()


@pytest.mark.parametrize("path", TEMPLATE_FILES, ids=lambda path: path.stem)
def test_templates_name_it_and_fulfil_it(path):
    text = path.read_text(encoding="utf-8")
    assert text.startswith(f"#:schema {FILE}\n")
    JUDGE.validate(tomllib.loads(text))


def test_everything_that_the_reader_takes():
    JUDGE.validate(tomllib.loads((ROOT / "tests" / "data" / "everything.toml").read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", FAULTS_OF_KEYS)
def test_faults_of_keys_are_refused(name):
    path = ROOT / "tests" / "errors" / f"{name}.toml"
    assert not JUDGE.is_valid(tomllib.loads(path.read_text(encoding="utf-8")))


def test_a_misspelt_key_is_refused():
    description = tomllib.loads(TEMPLATE_FILES[0].read_text(encoding="utf-8"))
    description["driver"]["stpe"] = description["driver"].pop("step")
    assert not JUDGE.is_valid(description)


def test_the_command_writes_it(tmp_path):
    target = tmp_path / FILE
    assert run("schema", "-o", target).exit_code == 0
    assert target.read_text(encoding="utf-8") == json_schema_text()
    assert json.loads(run("schema").stdout) == json_schema()
