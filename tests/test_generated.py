"""`generated/` is, byte for byte, what `build` makes of `templates/` now."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from chosen import some
from folders import ROOT, TEMPLATE_FILES
from mechsheet.description import load
from mechsheet.library.building import FORMATS, build

pytestmark = pytest.mark.slow


def test_nothing_else_is_there():
    expected = {f"{template.stem}.{suffix}" for template in TEMPLATE_FILES for suffix in FORMATS}
    assert len(expected) >= 42
    pages = {path.name for path in (ROOT / "generated").glob("*-page.*")}  # the layout page of the text's own four
    assert len(pages) == 4 * len(FORMATS)
    assert {path.name for path in (ROOT / "generated").iterdir()} == expected | pages


def differing_part(path: Path, kept: Path) -> str:
    """The first part of the archives that differs, and what stands where it does."""
    with zipfile.ZipFile(path) as ours, zipfile.ZipFile(kept) as theirs:
        for name in ours.namelist():
            new, old = ours.read(name), theirs.read(name) if name in theirs.namelist() else b""
            if new != old:
                at = next((at for at, pair in enumerate(zip(new, old, strict=False)) if pair[0] != pair[1]), 0)
                around = slice(max(0, at - 120), at + 60)
                return f"{name} at {at}: {new[around]!r} was {old[around]!r}"
    return "the parts are the same, their compression is not"


@pytest.mark.cases(1)
@pytest.mark.parametrize("template", some(TEMPLATE_FILES, 4, every=13), ids=lambda path: path.stem)
def test_same_bytes(template, tmp_path):
    for path in build(load(template), tmp_path, FORMATS):
        kept = ROOT / "generated" / path.name
        same = path.read_bytes() == kept.read_bytes()
        assert same, f"{path.name}: {differing_part(path, kept)}: run `make demo`"


OTHER_MACHINE = {
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL AVX512_SPR AVX2 FMA3 AVX512F AVX512_SKX",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F",
}
"""numpy and the C library as they are on a processor without fused operations; what they do not know they leave."""

PROGRAM = """
import sys, warnings
warnings.simplefilter("ignore")  # numpy tells of features that it does not know or have
import numpy as np
from mechsheet.description import load
from mechsheet.library.building import FORMATS, build
build(load(sys.argv[1]), sys.argv[2], FORMATS)
x = np.linspace(-3, 3, 9999)
print(np.arctan2(np.sin(x), np.exp(x)).tobytes().hex())
"""


@pytest.mark.ci
def test_another_processor_writes_the_same_bytes(tmp_path):
    """Sine and its like differ in the last digit there, and nothing that is written does."""
    template = ROOT / "templates" / "four-bar-forces.toml"
    answers = []
    for folder, other in (("this", {}), ("other", OTHER_MACHINE)):
        run = subprocess.run(
            [sys.executable, "-c", PROGRAM, template, tmp_path / folder],
            env=os.environ | other, capture_output=True, text=True, check=True,
        )  # fmt: skip
        answers.append(run.stdout)
    for path in sorted((tmp_path / "this").iterdir()):
        assert path.read_bytes() == (tmp_path / "other" / path.name).read_bytes(), path.name
    if answers[0] == answers[1]:
        pytest.skip("this processor's own functions give the same bits either way: nothing was tried")
