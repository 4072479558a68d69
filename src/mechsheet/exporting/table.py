"""csv: the driver, the variables, points and outputs over the sweep, one row per position, a unit in each heading."""

from __future__ import annotations

import csv
import io

from mechsheet.exporting.job import Job
from mechsheet.model import Mechanism
from mechsheet.show import variables_of


def write(job: Job) -> list[bytes]:
    """The table in UTF-8, every number with all its digits; nothing where the position does not exist."""
    units = units_of(job.mechanism)
    columns = variables_of(job.mechanism)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(f"{symbol} [{units[symbol]}]" if units[symbol] else symbol for symbol in columns)
    for row in zip(*columns.values(), strict=True):
        writer.writerow(["" if value is None else repr(value) for value in row])
    return [text.getvalue().encode()]


def units_of(mechanism: Mechanism) -> dict[str, str]:
    """The unit in which people read each variable ("deg", "rad", the length unit, or any label of an output)."""
    units: dict[str, str] = {link.angle_symbol: mechanism.angle_unit for link in mechanism.links[1:]}
    units |= {joint.symbol: mechanism.length_unit for joint in mechanism.joints}
    units |= {
        f"{point}.{axis}": mechanism.length_unit for link in mechanism.links for point in link.points for axis in "xy"
    }
    units |= {output.symbol: "" if output.unit == "1" else output.unit for output in mechanism.outputs}
    return units | {mechanism.driver.symbol: mechanism.driver.unit}
