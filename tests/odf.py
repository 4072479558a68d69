"""OpenDocument files against the schema of version 1.3, which lies in the package openxml-audit."""

from __future__ import annotations

import functools
import zipfile
from pathlib import Path

import openxml_audit
from lxml import etree

_SCHEMAS = Path(openxml_audit.__file__).parent / "odf" / "schemas" / "odf-1.3"
_EXTENSIONS = "{urn:org:documentfoundation:"


@functools.cache
def _schema(name):
    return etree.RelaxNG(etree.parse(str(schema_file(name))))


def schema_file(name):
    """Where the schema of a document ("schema") or of its list of parts ("manifest-schema") lies."""
    return _SCHEMAS / f"OpenDocument-v1.3-{name}.rng"


def document_parts(path):
    """(schema, part, tree) of every part, without the attributes of LibreOffice's extensions.

    (An extended document is valid when it is valid without what is foreign to the schema.)
    """
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            if name.endswith(".xml"):
                tree = etree.fromstring(archive.read(name))
                for element in tree.iter():
                    for key in [key for key in element.attrib if key.startswith(_EXTENSIONS)]:
                        del element.attrib[key]
                yield "manifest-schema" if name.startswith("META-INF") else "schema", name, tree


def schema_errors(path):
    """What the schema finds wrong in any part."""
    found = []
    for name, part, tree in document_parts(path):
        schema = _schema(name)
        schema.validate(tree)
        found += [f"{part}: {error.message}" for error in schema.error_log]
    return found
