"""Where the files of the project are, for tests."""

from pathlib import Path

ROOT = Path(__file__).parents[1]
TEMPLATES = ROOT / "templates"
TEMPLATE_FILES = sorted(TEMPLATES.glob("*.toml"))
TEMPLATE_NAMES = [path.stem for path in TEMPLATE_FILES]
