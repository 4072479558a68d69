"""The catalogues as Babel reads them: another reader than ours."""

from contextlib import contextmanager
from functools import cache
from pathlib import Path

from babel.messages.pofile import read_po

from mechsheet.words import catalogue

FOLDER = Path(catalogue.FOLDER)


def messages(language):
    """Every entry of a catalogue, without its head."""
    with (FOLDER / f"{language}.po").open("rb") as file:
        return [one for one in read_po(file, locale=language) if one.id]


@cache
def forms(language):
    """What is looked up and its plural forms in a language, one where nothing is counted; without what has a context."""
    entries = [one for one in messages(language) if not one.context]
    return {
        one.id[0] if one.pluralizable else one.id: one.string if one.pluralizable else (one.string,) for one in entries
    }


@cache
def texts(language):
    """What is looked up and what it is in a language, of plural forms the last; without what has a context."""
    return {key: strings[-1] for key, strings in forms(language).items()}


def pairs(begins=""):
    """Key, without what it begins with, -> its English and its Turkish."""
    english, turkish = texts("en"), texts("tr")
    return {key.removeprefix(begins): (english[key], turkish[key]) for key in english if key.startswith(begins)}


@contextmanager
def added(folder, language, further):
    """Texts that a test brings along, in a copy of the catalogues."""
    ours = catalogue.FOLDER
    for path in catalogue.FOLDER.glob("*.po"):
        (folder / path.name).write_bytes(path.read_bytes())
    lines = [f'\nmsgid "{key}"\nmsgstr "{text}"\n' for key, text in further.items()]
    with (folder / f"{language}.po").open("a", encoding="utf-8") as file:
        file.writelines(lines)
    catalogue.FOLDER = folder
    catalogue.catalogue.cache_clear()
    try:
        yield
    finally:
        catalogue.FOLDER = ours
        catalogue.catalogue.cache_clear()
