"""Studies in the library: `mechsheet.study`, and the changes that make a description one of a study's designs."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError
from mechsheet.model import Mechanism

_SIZE = re.compile(r"\s*(\d+(?:\.\d+)?)\s*(?:([KMGT])(i?)B?|B)?\s*", re.IGNORECASE)
_DESIGN = re.compile(r"(.+):\s*([\d_]+)\s*", re.DOTALL)


def study(
    mechanism: Mechanism,
    output: str | Path | None = None,
    *,
    workers: int = 1,
    on: str | None = None,
    resume: bool = False,
    limit_memory: str | int | None = None,
) -> Any:
    """Try all designs of [study] in the description; those that meet its conditions, as a pyarrow Table.

    A row for each design kept: its number, the dimensions varied, summaries and objectives, in the units that people read
    (`table.schema.field(name).metadata[b"unit"]`); null where there is no number; `remarks`, what its workbook says of them,
    and `set_apart`, whether a number that decides is one of rows only. What does not fit the memory is read from
    the folder instead: `pyarrow.dataset.dataset("FOLDER/parts")`.

    output        the folder of the study, as `mechsheet study -o` writes it; without it nothing is kept on disk
    workers       processes on this machine; more than one only in a script whose main part is guarded by
                  `if __name__ == "__main__":`
    on            address of a Dask scheduler that computes instead: "tcp://10.0.0.5:8786"
    resume        go on with a study that was begun in `output`
    limit_memory  what all processes together may have: "2GiB"; fewer processes where not all fit

    Raises MechsheetError: a description without a study, a mechanism that a study cannot evaluate, a folder of another
    study, an address that nobody answers; MissingProgramError without pyarrow (`mechsheet[study]`, `mechsheet[dask]`).
    """
    from mechsheet.studies.packages import arrow
    from mechsheet.studies.run import studied

    pa = arrow()
    memory = bytes_of(limit_memory)
    with tempfile.TemporaryDirectory() as spare:
        folder = Path(spare) / "study" if output is None else Path(output)
        found = studied(mechanism, folder, workers=workers, on=on, resume=resume, limit_memory=memory)
        return pa.concat_tables([pa.parquet.read_table(path) for path in found.folder.parts(found.order)])


def known_formats(formats: str | None) -> list[str]:
    """The formats of the summary workbook: "xlsx,ods". Raises MechsheetError for others."""
    from mechsheet.library.building import FORMATS, formats_given

    return list(FORMATS[:1]) if formats is None else formats_given(formats)


def bytes_of(size: str | int | None) -> int | None:
    """A size as a number of bytes: 2GiB is 2 x 1024^3, 500 MB is 500 x 1000^2. Raises MechsheetError."""
    if size is None or isinstance(size, int):
        return size
    found = _SIZE.fullmatch(size)
    if found is None:
        raise MechsheetError(
            Fault(say('"{size}" is no size', size=size), key="limit_memory", hint=say("for example 2GiB or 500MB"))
        )
    power = 0 if found[2] is None else "KMGT".index(found[2].upper()) + 1
    return int(float(found[1]) * (1024 if found[3] else 1000) ** power)


def design_of(given: str) -> tuple[list[tuple[str, str]], str, str]:
    """What `FOLDER:17` means: (values of its dimensions and modes by name, number of rows, the study's description).

    Raises MechsheetError for anything but a folder of a study and the number of one of its designs.
    """
    from mechsheet import description
    from mechsheet.studies.folder import read_manifest
    from mechsheet.studies.sampling import sampling_of

    found = _DESIGN.fullmatch(given)
    if found is None:
        message = say('"{given}" is not FOLDER:NUMBER', given=given)
        raise MechsheetError(
            Fault(message, key="design", hint=say("the folder of a study and a design's number in it: wiper:17"))
        )
    manifest = read_manifest(Path(found[1]))
    text = manifest["description"]
    plan = description.loads(text, found[1]).study
    number = int(found[2].replace("_", ""))
    if plan is None:
        raise MechsheetError(Fault(say("the folder's description has no part [study]"), found[1]))
    sampling = sampling_of(plan)
    if not 1 <= number <= sampling.total:
        raise MechsheetError(
            Fault(
                say("there is no design {number}: they go from 1 to {total:,}", number=number, total=sampling.total),
                found[1],
                key="design",
            )
        )
    values = sampling.values(np.array([number - 1], np.int64))[0]
    pairs = [(one.symbol, repr(float(value))) for one, value in zip(plan.vary, values, strict=True)]
    pairs += [(mode, str(int(value))) for mode, value in manifest.get("modes", {}).items()]
    return pairs, str(manifest.get("rows", "")), text
