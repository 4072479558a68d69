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
    return etree.RelaxNG(etree.parse(str(_SCHEMAS / f"OpenDocument-v1.3-{name}.rng")))


def schema_errors(path):
    """What the schema finds wrong in any part, without the attributes of LibreOffice's extensions.

    (An extended document is valid when it is valid without what is foreign to the schema.)
    """
    found = []
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            if name.endswith(".xml"):
                tree = etree.fromstring(archive.read(name))
                for element in tree.iter():
                    for key in [key for key in element.attrib if key.startswith(_EXTENSIONS)]:
                        del element.attrib[key]
                schema = _schema("manifest-schema" if name.startswith("META-INF") else "schema")
                schema.validate(tree)
                found += [f"{name}: {error.message}" for error in schema.error_log]
    return found
