"""The parts of a study: designs that follow each other, computed together and written as one Parquet file.

Which designs a part has follows from the study alone, and so do its bytes: whoever computes it, in whatever order.
"""

from __future__ import annotations

import hashlib
import io
import json
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from mechsheet import description
from mechsheet.studies.chunk import Kept, kept_of
from mechsheet.studies.designs import APART, DESIGN, REMARKS, Designs
from mechsheet.studies.packages import arrow, versions

CHUNK = 4_096
"""Designs that are evaluated together."""

LEAST_PARTS = 64
MOST_DESIGNS = 65_536
MOST_PARTS = 100_000
"""A part has up to so many designs, fewer where there would be few parts, more where there would be too many."""

ROW_GROUP, GROUP_VALUES = 65_536, 2**19
"""Rows of a Parquet file that are written together, fewer of many columns: what a part holds in memory."""

METADATA = b"mechsheet"
"""Under this key a part says of which study it is, how many designs it tried, kept, set apart, and why it left the others
out."""


@dataclass(frozen=True)
class Order:
    """What whoever computes parts is told: the description, how many designs, how many in a part, releases of packages."""

    text: str
    designs: int
    size: int
    versions: tuple[tuple[str, str], ...]

    @property
    def parts(self) -> int:
        """How many there are."""
        return -(-self.designs // self.size)

    @cached_property
    def study(self) -> str:
        """The name of the study, which each of its parts bears: a digest of all that decides its bytes."""
        whole = json.dumps([self.text, self.designs, self.size, self.versions])
        return hashlib.sha256(whole.encode()).hexdigest()[:16]

    def span(self, part: int) -> range:
        """The numbers of its designs, from 0."""
        return range(part * self.size, min((part + 1) * self.size, self.designs))


def order_of(text: str, designs: int) -> Order:
    """The order of a study of so many designs."""
    size = min(MOST_DESIGNS, -(-designs // LEAST_PARTS))
    size = max(size, -(-designs // MOST_PARTS))
    return Order(text, designs, -(-size // CHUNK) * CHUNK, tuple(versions().items()))


@lru_cache(maxsize=2)
def designs_of(text: str) -> Designs:
    """The designs of a description's study; a process keeps them."""
    return Designs(description.loads(text))


@dataclass(frozen=True, slots=True)
class Done:
    """A part that was computed: its number and its file's bytes, which say what was tried and kept (`counted`)."""

    part: int
    data: bytes


def compute(order: Order, part: int) -> Done:
    """Compute a part. Raises VersionsError where other releases of the packages are installed than where it was ordered."""
    if dict(order.versions) != versions():
        raise VersionsError(order.versions, tuple(versions().items()))
    designs = designs_of(order.text)
    span = order.span(part)
    file = io.BytesIO()
    kept, apart, failed = 0, 0, [0] * len(designs.questions.conditions)
    group = min(ROW_GROUP, GROUP_VALUES // len(designs.names))
    with arrow().parquet.ParquetWriter(file, schema_of(designs), compression="zstd") as writer:
        waiting: list[Any] = []
        for first in range(span.start, span.stop, CHUNK):
            found = kept_of(designs, first, min(CHUNK, span.stop - first))
            failed = [count + int(more) for count, more in zip(failed, found.failed, strict=True)]
            kept += len(found.numbers)
            apart += int(found.apart.sum())
            if len(found.numbers):
                waiting.append(_batch(designs, found))
            if sum(batch.num_rows for batch in waiting) >= group:
                _write(writer, waiting)
        _write(writer, waiting)
        told = {"study": order.study, "designs": len(span), "kept": kept, "apart": apart, "failed": failed}
        writer.add_key_value_metadata({METADATA.decode(): json.dumps(told)})
    return Done(part, file.getvalue())


class VersionsError(Exception):
    """Another release of a package: the bytes might differ."""


def schema_of(designs: Designs) -> Any:
    """The columns: the number of the design, then dimensions, summaries and objectives with their units, then remarks."""
    pa = arrow()
    units = {one: designs.units[one].text for one in designs.varied}
    units |= {quantity.name: quantity.unit for quantity in designs.questions.quantities}
    columns = [pa.field(name, pa.float64(), metadata={"unit": units.get(name, "")}) for name in designs.names]
    own = [pa.field(REMARKS, pa.string()), pa.field(APART, pa.bool_(), nullable=False)]
    return pa.schema([pa.field(DESIGN, pa.int64(), nullable=False), *columns, *own])


def units_of(schema: Any) -> dict[str, str]:
    """The units of such columns by their names, "" for none."""
    return {field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in schema}


def heads_of(table: Any) -> list[str]:
    """The names of a table's columns with their units."""
    return [f"{name} [{unit}]" if unit else name for name, unit in units_of(table.schema).items()]


def told_of(table: Any) -> tuple[Any, list[str | None]]:
    """A table of designs without the columns that are no numbers, and the remarks on them."""
    return table.drop_columns([REMARKS, APART]), table.column(REMARKS).to_pylist()


def _batch(designs: Designs, found: Kept) -> Any:
    """The designs kept; what has no number is null."""
    pa = arrow()
    columns = [pa.array(found.columns[name], from_pandas=True) for name in designs.names]
    own = [pa.array(found.remarks.tolist(), pa.string()), pa.array(found.apart)]
    return pa.record_batch([pa.array(found.numbers + 1), *columns, *own], schema=schema_of(designs))


def _write(writer: Any, waiting: list[Any]) -> None:
    if waiting:
        writer.write_table(arrow().Table.from_batches(waiting), row_group_size=2 * ROW_GROUP)
        waiting.clear()


@dataclass(frozen=True, slots=True)
class Counted:
    """What a part's file says of it; `study`: whose it is."""

    study: str
    designs: int
    kept: int
    apart: int
    failed: tuple[int, ...]


def counted(file: Any) -> Counted | None:
    """What the metadata of a part's file say; None for a file that is none."""
    pa = arrow()
    try:
        metadata = pa.parquet.read_metadata(file).metadata or {}
        told = json.loads(metadata[METADATA])
        failed = tuple(int(count) for count in told["failed"])
        return Counted(str(told["study"]), int(told["designs"]), int(told["kept"]), int(told["apart"]), failed)
    except (OSError, ValueError, KeyError, TypeError, pa.ArrowException):
        return None
