"""The folder of a study: its manifest, its parts, whether it is the folder of this study; one study at a time has it.

study.json       name of the study, description, sampling, columns, conditions, releases of packages: written first
parts/           part-000000.parquet and so on, each whole or not there, with the name of its study
result.json      how many designs were tried, kept and set apart, how many failed each condition: written last
.study.lock      while a study is computed here

The system holds the lock for a process, and lets go of it however the process ends: a file that a killed study has left is
locked by nobody, and the next study takes it. On a file system that has no locks a study goes on without one; then the
parts, which name their study, tell what was mixed.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault, OutputError, readable_name, system_reason
from livesheet.replacing import make_folder, output_error, replace_file
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.studies.designs import Designs
from mechsheet.studies.packages import unlike
from mechsheet.studies.parts import Counted, Done, Order, counted, schema_of, units_of

MANIFEST, RESULT, PARTS = "study.json", "result.json", "parts"
FORMAT = 1


@dataclass(frozen=True, slots=True)
class Result:
    """What a study has found: designs tried, kept, and of these set apart; how many failed each condition, in the order of
    the asking."""

    designs: int
    kept: int
    apart: int
    failed: tuple[tuple[str, int], ...]


class Folder:
    """A study's folder on disk."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @property
    def shown(self) -> str:
        """Its name in messages."""
        return readable_name(self.path)

    def part(self, number: int) -> Path:
        """The file of a part."""
        return self.path / PARTS / f"part-{number:06d}.parquet"

    def parts(self, order: Order) -> list[Path]:
        """The files of all parts, in order."""
        return [self.part(number) for number in range(order.parts)]

    # --- beginning --------------------------------------------------------------------------------------------------------

    def open(self, resume: bool) -> None:
        """Make the folder, where there is none. Raises OutputError, also where there is nothing to resume."""
        if self.path.exists() and not self.path.is_dir():
            raise OutputError(Fault(say("is a file: a study is written into a folder"), self.shown, key="-o"))
        if resume and not self.path.exists():
            raise OutputError(
                Fault(say("there is no study to resume"), self.shown, hint=say("leave --resume out to begin it"))
            )
        make_folder(self.path)

    def begin(self, designs: Designs, order: Order, resume: bool) -> None:
        """Make the folder, which is locked, this study's, or find that it is. Raises OutputError where it is another's, or
        begun and not to be resumed."""
        manifest = manifest_of(designs, order)
        path = self.path / MANIFEST
        if path.exists() and (resume or self._has_parts()):
            self._compare(manifest)
            if not resume:
                message = say("this study has been begun here")
                hint = say("go on with --resume, or name another folder with -o")
                raise OutputError(Fault(message, self.shown, hint=hint))
            return
        if not path.exists() and any(each.is_file() and not _is_spare(each) for each in self.path.rglob("*")):
            message = say("holds other files, and no study")
            raise OutputError(Fault(message, self.shown, hint=say("name a new or an empty folder with -o")))
        make_folder(self.path / PARTS)
        replace_file(path, _json(manifest))

    def _has_parts(self) -> bool:
        """Whether anything is lost when another study takes the folder."""
        return any(self.path.glob(f"{PARTS}/*.parquet"))

    def _compare(self, manifest: dict[str, Any]) -> None:
        """Raise OutputError with what differs where the folder is another study's."""
        there = read_manifest(self.path)
        differing = [key for key in manifest if key != "study" and there.get(key) != manifest[key]]
        if not differing:
            return
        if differing == ["versions"]:
            others = unlike(manifest["versions"], there.get("versions", {}))
            message = say("the study was begun with {others}: its end might differ from its beginning", others=others)
            raise OutputError(
                Fault(
                    message,
                    self.shown,
                    hint=say(
                        "go on with these releases, on a processor that computes alike, or begin anew in another folder"
                    ),
                )
            )
        message = say("is the folder of another study: it differs in {differing}", differing=", ".join(differing))
        raise OutputError(Fault(message, self.shown, hint=say("name another folder with -o")))

    # --- going on ---------------------------------------------------------------------------------------------------------

    def done(self, order: Order, conditions: int) -> dict[int, Counted]:
        """The parts that are there and whole, by number."""
        found = {}
        for number, path in enumerate(self.parts(order)):
            part = counted(path) if path.exists() else None
            if part is not None and part.study == order.study and len(part.failed) == conditions:
                found[number] = part
        return found

    def check(self, order: Order) -> None:
        """Raise OutputError where a part is not this study's: on a file system without locks another may have written."""
        for path in self.parts(order):
            part = counted(path)
            if part is None or part.study != order.study:
                message = say("another study has written into this folder at the same time")
                hint = say("go on with --resume: parts that are not of this study are computed again")
                raise OutputError(Fault(message, readable_name(path), hint=hint))

    def keep(self, done: Done) -> None:
        """Write a part. Raises OutputError."""
        make_folder(self.path / PARTS)
        replace_file(self.part(done.part), done.data)

    def finish(self, designs: Designs, parts: Iterable[Counted]) -> Result:
        """Write the counts of all parts."""
        texts = [condition.text for condition in designs.questions.conditions]
        failed = [0] * len(texts)
        tried = kept = apart = 0
        for part in parts:
            tried, kept, apart = tried + part.designs, kept + part.kept, apart + part.apart
            failed = [count + more for count, more in zip(failed, part.failed, strict=True)]
        result = Result(tried, kept, apart, tuple(zip(texts, failed, strict=True)))
        told = [{"condition": text, "designs": count} for text, count in result.failed]
        replace_file(self.path / RESULT, _json({"designs": tried, "kept": kept, "set apart": apart, "failed": told}))
        return result


def manifest_of(designs: Designs, order: Order) -> dict[str, Any]:
    """The manifest of a study: nothing in it depends on when, where or by how many processes it is computed."""
    return {
        "format": FORMAT,
        "study": order.study,
        "versions": dict(order.versions),
        "sample": designs.study.sample,
        "seed": designs.study.seed,
        "designs": order.designs,
        "designs in a part": order.size,
        "rows": designs.rows,
        "columns": units_of(schema_of(designs)),
        "conditions": [condition.text for condition in designs.questions.conditions],
        "modes": designs.modes,
        "description": order.text,
    }


def read_manifest(folder: Path) -> dict[str, Any]:
    """The manifest of a study's folder. Raises MechsheetError where there is none that can be read."""
    path = folder / MANIFEST
    shown = readable_name(path)
    try:
        found = json.loads(path.read_bytes())
    except OSError as error:
        hint = say("the folder that mechsheet study wrote")
        raise MechsheetError(
            Fault(say("cannot be read: {reason}", reason=system_reason(error)), shown, hint=hint)
        ) from error
    except ValueError as error:
        raise MechsheetError(Fault(say("is no manifest of a study"), shown)) from error
    if not isinstance(found, dict) or found.get("format") != FORMAT or not isinstance(found.get("description"), str):
        raise MechsheetError(Fault(say("is no manifest of a study that this program knows"), shown))
    return found


def _is_spare(path: Path) -> bool:
    """Whether a file is nobody's: what a process that was killed has left, or the lock."""
    return path.suffix == ".tmp" or path.name == LOCK


def _json(data: dict[str, Any]) -> bytes:
    return (json.dumps(data, indent=1, ensure_ascii=False) + "\n").encode()


LOCK = ".study.lock"
"""The file that is locked, in the study's folder."""

if sys.platform == "win32":
    import msvcrt

    def _lock(file: int) -> None:
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder that is there. Raises OutputError where another study holds it, or nobody may write."""
    path = folder / LOCK
    file = _taken(path)
    try:
        yield
    finally:
        if sys.platform == "win32":  # an open file cannot be removed there
            os.close(file)
        with suppress(OSError):
            path.unlink()
        if sys.platform != "win32":
            os.close(file)


def _taken(path: Path) -> int:
    """The lock's file, open and locked."""
    while True:
        try:
            file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        except OSError as error:
            if sys.platform == "win32" and isinstance(error, PermissionError) and path.exists():
                raise _busy(path) from error  # it is being removed
            raise output_error(path, error) from error
        try:
            _lock(file)
        except (BlockingIOError, PermissionError) as error:
            os.close(file)
            raise _busy(path) from error
        except OSError:
            return file  # a file system without locks
        if _is_at(path, file):
            return file
        os.close(file)  # whoever held it has removed it: it locks nothing any more


def _is_at(path: Path, file: int) -> bool:
    """Whether the file is still the one of that name."""
    try:
        return os.path.samestat(path.stat(), os.fstat(file))
    except OSError:
        return False


def _busy(path: Path) -> OutputError:
    message = say("another study is being computed in this folder")
    hint = say("wait for its end, or name another folder with -o")
    return OutputError(Fault(message, readable_name(path.parent), hint=hint))
