"""Where Newton's method begins after dimensions were typed: in the described assembly, or it says that it may not be."""

import math

import numpy as np
import pytest
from laid import Laid
from placed import places_of

import mechsheet
from chosen import ALL, ITERATED, first, part
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.newton.system import CLOSED, leading, refined
from mechsheet.kinematics.numeric import evaluate_equation
from mechsheet.sheet.columns.lowering import in_pass
from mechsheet.sheet.plan import MEANING
from random_mechanisms import Grower

pytestmark = pytest.mark.slow

CHANGES = 150 if ALL else 25
STEPS, FINER = 200, 4_000
"""Steps to the changed dimensions; more of them before it is said that the sheet is wrong."""

ALARMS = 0.04
"""Of the changes after which it begins where it ought to, so many at most are told to be doubtful all the same."""
KEPT, BEGUN = (f"verdict.same_assembly.{word}" for word in ("kept", "begun"))


class Followed:
    """The described assembly of a workbook's group, followed in many small steps to other dimensions: what ought to be."""

    def __init__(self, sheet):
        self.sheet = sheet
        equations = sheet.plan.equations.equations
        self.group = next(group for group in equations.groups if group.system is not None)
        self.system = system = self.group.system
        dimensions, driver = dimension_values(sheet.mechanism), sheet.mechanism.driver.symbol
        self.described = dimensions | {driver: system.home}
        rules = {each.symbol: each.reads for each in equations.all if each.role != "iteration"}
        self.leaves, names = leading(system.given, rules, [*self.described])
        self.way = [each for each in equations.all if each.symbol in names or each in equations.constants]
        self.modes = {group.mode: float(group.mode_value) for group in equations.groups}
        begin = [sheet.plan.at.spots[in_pass(name, 0)] for name in (*system.unknowns, system.residual)]
        status = places_of(sheet.plan)["status"]
        sheet.only(
            *((spot.sheet, spot.row, spot.col) for spot in begin),
            *((status.sheet, status.row + row, status.col) for row in range(sheet.plan.rows)),
            (sheet.plan.main, sheet.plan.blocks["verdicts"].rows["same_assembly"], MEANING),
        )
        self.scale = np.array(
            [
                1.0 if sheet.plan.equations.of(name).unit.kind == "angle" else max(map(abs, dimensions.values()))
                for name in system.variables
            ]
        )

    def to(self, changes, steps=STEPS):
        """The unknowns that each of so many (symbol, value) leads to, NaN where the assembly ends on the way."""
        count = len(changes)
        ends = {name: np.full(count, value) for name, value in self.described.items()}
        for place, (symbol, value) in enumerate(changes):
            ends[symbol][place] = value
        unknowns = [np.full(count, value) for value in self.system.starts[self.group.assembly]]
        lost, sign, before = np.zeros(count, bool), 0.0, 0.0
        for step in range(steps + 1):
            known = self.modes | {
                name: value + step / steps * (ends[name] - value) for name, value in self.described.items()
            }
            for equation in self.way:
                known[equation.symbol] = evaluate_equation(equation, known, count)
            found, residual, determinant = refined(self.system, known, unknowns, 4)
            sign = np.sign(determinant) if step == 0 else sign
            moved = (np.array(found) - np.array(unknowns)) / self.scale[:, None]
            leapt = np.max(np.abs(moved - before), axis=0) > 0.2 if step > 1 else False
            lost |= ~((residual <= CLOSED) & (determinant * sign > 0)) | leapt
            unknowns, before = found, moved
        return np.where(lost, np.nan, unknowns).T

    def begins(self):
        """The unknowns at which the sheet's first row begins; None where it begins nowhere."""
        found = [self.sheet.spot(in_pass(name, 0)) for name in self.system.unknowns]
        residual = self.sheet.spot(in_pass(self.system.residual, 0))
        there = all(isinstance(each, float) for each in (*found, residual)) and residual <= CLOSED
        return np.array(found) if there else None

    def same(self, one, other):
        """Whether two positions are one, up to whole turns."""
        gap = one - other
        gap = np.where(self.scale == 1.0, gap - math.tau * np.round(gap / math.tau), gap)
        return bool(np.max(np.abs(gap) / self.scale) < 1e-6)  # not where NaN says that the assembly ends


def typed(random, followed):
    """A dimension of the group, or the driver's first value, changed at random: (cell, as typed, (symbol, as meant))."""
    driver = followed.sheet.mechanism.driver
    own = {dim.symbol: dim for dim in followed.sheet.mechanism.dimensions if dim.symbol in followed.leaves}
    names = [name for name, dim in own.items() if not dim.derived]
    if not names or random.random() < 0.15:
        value = followed.system.home + random.uniform(-1.2, 1.2) * (0.4 if driver.joint else 1.0)
        return "_start", float(driver.unit.to_shown(value)), (driver.symbol, value)
    name = names[random.integers(len(names))]
    value = followed.described[name]
    turns = own[name].unit.kind == "angle"
    value = value + random.uniform(-1.0, 1.0) if turns else value * random.uniform(0.4, 1.8)
    return name, float(own[name].unit.to_shown(value)), (name, value)


def judged(text, seed, count):
    """What became of so many changes: how often it begins where it ought to, doubts that wrongly, leaps in silence."""
    sheet = Laid(text)
    followed = Followed(sheet)
    random = np.random.default_rng(seed)
    fine = ended = nowhere = alarms = 0
    silent = []
    changes = [typed(random, followed) for _ in range(count)]
    truths = followed.to([meant for _, _, meant in changes])
    for (cell, number, meant), truth in zip(changes, truths, strict=True):
        sheet.change(**{cell: number})
        here, words = followed.begins(), sheet.words("same_assembly")
        calm = any(sheet.exists) and words == sheet.plan.text(KEPT)
        if calm and here is not None and not followed.same(here, truth):
            (truth,) = followed.to([meant], FINER)  # near a limit the steps are too large
        if here is None:
            nowhere += 1
            assert not any(sheet.exists), (text, cell, number)
        elif not followed.same(here, truth):
            ended += 1
            if calm:
                silent.append((text, cell, number))
        else:
            fine += 1
            alarms += words == sheet.plan.text(BEGUN)
    return np.array([fine, ended, nowhere, alarms]), silent


def text_of(seed):
    """A random linkage of class III or IV."""
    return Grower(seed, 1, (("III", "IV")[seed % 2],)).text(rows=3, step=1.0)


@pytest.mark.ci
@pytest.mark.parametrize("name", part(ITERATED, 4, 2))
def test_templates_do_not_leap_in_silence(name):
    counts, silent = judged(template_text(name), 1, CHANGES)
    assert not silent
    fine, _, _, alarms = counts
    assert fine > CHANGES // 3
    assert alarms <= ALARMS * fine + 1


@pytest.mark.ci
def test_random_groups_do_not_leap_in_silence(record_property):
    total, amiss = np.zeros(4, int), []
    for seed in first(range(100, 136), 4):
        try:
            counts, silent = judged(text_of(seed), seed, CHANGES)
        except (MechsheetError, StopIteration):
            continue
        total += counts
        amiss += silent
    assert not amiss
    fine, ended, _, alarms = total
    record_property("changes", f"{total[:3].sum()} changes: {total.tolist()} fine, ended, nowhere, alarms")
    assert total[:3].sum() >= (5_000 if ALL else 100)
    assert fine > 20
    assert ended > 0
    assert alarms <= ALARMS * fine + 1


def test_the_driver_may_begin_elsewhere():
    """The start is led along by the driver, too, as if the mechanism had been moved there."""
    sheet = Laid(template_text("stephenson-iii-output"))
    followed = Followed(sheet)
    driver = sheet.mechanism.driver
    sheet.change(_start=float(driver.unit.to_shown(followed.system.home + 0.3)))
    assert followed.same(followed.begins(), followed.to([(driver.symbol, followed.system.home + 0.3)])[0])
    assert sheet.words("same_assembly") == sheet.plan.text(KEPT)


@pytest.mark.cases(1)
@pytest.mark.parametrize("language", ["en", "tr"])
def test_the_line_under_the_title_says_where_the_assembly_ends(language):
    sheet = Laid(template_text("stephenson-ii-class-iv"), language)
    assert sheet.words("same_assembly") == sheet.plan.text(KEPT)
    sheet.change(v=2.2834089501311663)  # where Newton lands then is chance
    assert any(sheet.exists)
    assert sheet.words("same_assembly") == sheet.verdict == sheet.plan.text(BEGUN)
    sheet.change(v=1.65)
    assert not any(sheet.exists)
    assert sheet.verdict == sheet.plan.text("verdict.line.ended")


@pytest.mark.cases(1)
@pytest.mark.ci
@pytest.mark.parametrize("v", [2.2834089501311663, 1.65])
def test_check_agrees_where_the_assembly_ends(tmp_path, v):
    """Somebody has typed it and saved: nothing is wrong with the workbook."""
    (path,) = mechsheet.template("stephenson-ii-class-iv").build(tmp_path, formats=["xlsx"])
    mechsheet.recalc(path, {"v": v}).write(tmp_path / "typed.xlsx")
    report = mechsheet.check(tmp_path / "typed.xlsx")
    assert all(found.agrees for found in report.comparisons)
    assert bool(report.red_line) == (v == 1.65)  # there is no position, and the line says so


def test_what_leads_to_a_group():
    rules = {"c": ["a"], "d": ["b"], "e": ["c", "x"], "f": ["e"]}
    assert leading(["e", "d"], rules, ["a", "g"]) == (("a",), ("c", "e"))
    assert leading(["e"], rules, ["c"]) == (("c",), ("e",))
