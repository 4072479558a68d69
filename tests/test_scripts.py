"""Tools and benchmarks find what they import: they run so seldom that nobody would notice before they are needed."""

import subprocess
import sys

import pytest

from folders import ROOT

SCRIPTS = [
    path.relative_to(ROOT)
    for folder in ("tools", "benchmarks")
    for path in sorted((ROOT / folder).glob("*.py"))
    if '__name__ == "__main__"' in path.read_text(encoding="utf-8")
]


@pytest.mark.ci
@pytest.mark.parametrize("script", SCRIPTS, ids=str)
def test_a_script_finds_what_it_imports(script):
    """In a process of its own, without what other tests have put on the path."""
    loading = "import runpy, sys; sys.path[0] = sys.argv[1]; runpy.run_path(sys.argv[2], run_name='imported')"
    command = [sys.executable, "-c", loading, script.parent, script]
    asked = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert asked.returncode == 0, asked.stderr
