"""What the first sheet says of a motion, judged by a dense numerical sweep.

The judge knows the equations as mathematics (`kinematics.sweep`), never the sheet's formulas: it sweeps the driver
between its first and last value on a fine grid, finds by halving and narrowing where the mechanism closes and where
quantities are extreme, and compares with the named cells after inputs were typed. A wrong word counts as a failure.
`tools/claims.py` runs it over all templates and random mechanisms.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from placed import places_of

from livesheet.formula.nodes import ErrorValue
from mechsheet.kinematics.numeric import value as number_of
from mechsheet.kinematics.rates.sensitivity import toleranced
from mechsheet.kinematics.search import TURN
from mechsheet.sheet.checks.search_rules import STRETCHES
from mechsheet.sheet.findings import cam, task
from mechsheet.sheet.findings.closing import closes_in_all
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.geometry import distance
from mechsheet.sheet.grashof import has_advice, named
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE, VERDICT_ROW
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.words.equations import link_words
from mechsheet.words.symbols import plain

EXTREME = 1e-4
LIMIT = 1e-5

GROWN = 3.0
"""What is said to grow without bound goes beyond the rows by more than so many of their ranges."""


@dataclass
class Claims:
    """What was found: how many claims of each kind, and the wrong ones."""

    judged: Counter = field(default_factory=Counter)
    wrong: list = field(default_factory=list)

    def say(self, kind, right, *details):
        self.judged[kind] += 1
        if not right:
            self.wrong.append((kind, *details))


# --- judging -------------------------------------------------------------------------------------------------------------

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def numbers_in(text):
    return [float(part) for part in NUMBER.findall(text)]


def close(found, truth, tolerance):
    return isinstance(found, float) and abs(found - truth) <= tolerance


def trapezia(column, there):
    """The mean over neighbouring rows that exist; of the rows where there are none such."""
    pairs = [(column[n] + column[n + 1]) / 2 for n in range(len(column) - 1) if there[n] and there[n + 1]]
    return float(np.mean(pairs or column[there]))


def missing(value):
    return isinstance(value, ErrorValue)


def judge(sheets, inputs, claims, where):
    """All that the first sheet says with these inputs."""
    sheets.type(inputs)
    judge_typed(sheets, inputs, claims, where)


def judge_typed(sheets, inputs, claims, where):
    """The same, where they have been typed."""
    _Judge(sheets, inputs, claims, where).all()


class _Judge:
    def __init__(self, sheets, inputs, claims, where):
        self.sheets, self.plan, self.claims = sheets, sheets.plan, claims
        self.where = (where, inputs)
        self.inputs = inputs
        self.found = self.plan.found
        self.text = self.plan.text

    def say(self, kind, right, *details):
        self.claims.say(kind, bool(right), *self.where, *details)

    def verdict(self, key, **parts):
        return self.text(f"verdict.{key}", **parts)

    def all(self):
        self.no_errors_in_words()
        if self.wrong_inputs():
            self.refused()
            return
        try:
            self.truth = self.sheets.truth_of({key: value for key, value in self.inputs.items() if key != "position"})
        except (ValueError, ArithmeticError):  # a derived dimension, or a place over dimensions, that does not exist
            self.say("impossible: red", self.sheets.colour(VERDICT_ROW, 0) == "red", self.sheets.colour(VERDICT_ROW, 0))
            return
        if self.truth.step == 0 and self.truth.stepped:
            return
        if any(not np.isfinite(self.truth.at[each.symbol]).all() for each in self.truth.equations.constants):
            self.say("impossible: red", self.sheets.colour(VERDICT_ROW, 0) == "red", self.sheets.colour(VERDICT_ROW, 0))
            return
        self.rows_closed()
        self.line()
        if not self.truth.count:
            loops = [f"grashof_{loop.group}" for loop in self.found.four_bars]
            for key in self.plan.places.lines:
                if key not in ("sheets", "inputs", "rows_closed", "input_from", *loops):
                    self.say(
                        "nothing else said where nothing closes",
                        not self.sheets.words(key),
                        key,
                        self.sheets.words(key),
                    )
        if self.found.limits:
            self.limits()
            self.input_range()
            self.passes()
        self.gap_and_leaps()
        for loop in self.found.four_bars:
            self.grashof(loop)
        # what happens between rows that the sheet warns of is not said to be known
        self.warned = self.found.limits and self.sheets.of("passes") != 0.0
        for link in self.found.swings:
            self.extent(f"swing_{link.angle_symbol}", link.angle_symbol, True)
        for joint in self.found.strokes:
            self.extent(f"stroke_{joint.symbol}", joint.symbol, False)
        for symbol in self.found.returning:
            self.ratio(symbol)
        for group in self.found.transmission:
            self.transmission(group)
        for summary in self.plan.mechanism.summaries:
            self.summary(summary)

    def wrong_inputs(self):
        spots = places_of(self.plan)
        for symbol, value in self.inputs.items():
            if not isinstance(value, float):
                return True
            if symbol in self.plan.equations.positive and not value > 0:
                return True
            if any(symbol == group.mode and value not in group.mode_values for group in self.plan.equations.groups):
                return True
            if symbol == "position" and value not in range(self.plan.rows):
                return True
            assert symbol in spots
        return False

    def refused(self):
        sheets = self.sheets
        if set(self.inputs) != {"position"}:
            self.say("wrong input: no row closes", sheets.of("rows_closed") == 0.0, sheets.of("rows_closed"))
        self.say("wrong input: red", sheets.colour(VERDICT_ROW, 0) == "red", sheets.colour(VERDICT_ROW, 0))
        line = sheets.cell(VERDICT_ROW, 0)
        symbol = next(iter(self.inputs))
        name = self.text("name.position") if symbol == "position" else plain(symbol)
        self.say("wrong input: words", line == self.verdict("inputs.wrong", symbol=name), line)
        spot = places_of(self.plan)[symbol]
        self.say("wrong input: red cell", sheets.colour(spot.row, spot.col) == "red", symbol)

    def no_errors_in_words(self):
        sheets = self.sheets
        texts = [sheets.cell(VERDICT_ROW, 0), *(sheets.words(key) for key in self.plan.places.lines)]
        for summary in self.plan.mechanism.summaries:
            texts.append(sheets.cell(self.plan.blocks["summary"].rows[summary.symbol], MEANING))
        for text in texts:
            self.say("words without errors", isinstance(text, str) and "#" not in text, text)

    # --- rows and stretches ----------------------------------------------------------------------------------------------

    def rows_closed(self):
        truth, sheets = self.truth, self.sheets
        count = sheets.of("rows_closed")
        self.say("rows_closed", count == truth.count, count, truth.count)
        words = sheets.words("rows_closed")
        if truth.count == 0:
            right = words == self.verdict("rows.none")
        elif truth.count == truth.rows:
            right = words == self.verdict("rows.all")
        else:
            ends = [float(truth.driver(end)) * truth.scale for stretch in truth.row_stretches[:3] for end in stretch]
            said = numbers_in(words)
            right = words.startswith(self.verdict("rows.some")) and (
                not said or np.allclose(said, ends[: len(said)], atol=0.0051)
            )
            right = right and (words.endswith("…") or len(said) == 2 * len(truth.row_stretches))
        self.say("rows_closed words", right, words, truth.row_stretches)

    def limits(self):
        truth, sheets = self.truth, self.sheets
        limits = truth.limits()
        count = sheets.of("limits")
        self.say("limits", count == len(limits), count, len(limits))
        words = sheets.words("limits")
        if words == self.verdict("limits.none"):
            self.say(
                "limits words",
                truth.closes_everywhere
                or truth.doubtful
                or (truth.count == 0 and not truth.peeps and not truth.there.any()),
                words,
                list(truth.edges),
                truth.dips,
                truth.peeps,
            )
        if not truth.stepped:
            return
        for number_, (_row, places) in enumerate(limits[:4], 1):
            key = f"limit_{number_}"
            if key not in places_of(self.plan):
                continue
            shown = sheets.spot(key)
            u = truth.place(shown) if isinstance(shown, float) else math.nan
            tolerance = LIMIT if self.verdict("within") not in words else 1.0
            self.say("limit", any(abs(u - place) <= tolerance for place in places), number_, u, places)
            if isinstance(shown, float) and number_ <= 2:
                said = numbers_in(words)
                self.say(
                    "limit in words",
                    not said or len(said) < number_ or abs(said[number_ - 1] - shown) < 0.0051,
                    words,
                    shown,
                )
        for number_ in range(len(limits) + 1, 5):
            if f"limit_{number_}" in places_of(self.plan):
                shown = sheets.spot(f"limit_{number_}")
                self.say("limit", missing(shown) or shown == "", number_, shown)

    def input_range(self):
        truth, sheets = self.truth, self.sheets
        low, high, words = sheets.of("input_from"), sheets.of("input_to"), sheets.words("input_from")
        if not truth.count:
            self.say("input", missing(low) and missing(high), low, high)
            return
        within = self.verdict("within") in sheets.words("limits")
        if truth.stepped:
            self.say("input words", (self.verdict("within") in words) == within, words)
        words = words.removesuffix(self.verdict("within"))
        first, last = truth.row_stretches[0]
        ends = []
        for row, other in ((first, first - 1), (last, last + 1)):
            between = [edge for edge in truth.edges if min(row, other) - 1e-9 <= edge <= max(row, other) + 1e-9]
            inside = 1 <= other <= truth.rows
            ends.append(between if inside and between else [float(row)])
        if not truth.stepped:
            rows = sorted(map(float, range(first, last + 1)), key=truth.driver)
            ends = [rows[:1], rows[-1:]]
        for shown, places in zip((low, high), ends, strict=True):
            right = isinstance(shown, float) and any(
                abs(shown - float(truth.driver(place)) * truth.scale)
                <= (1.0 if within else LIMIT) * abs(truth.step) * truth.scale + 1e-9
                for place in places
            )
            self.say(
                "input", right, low, high, [[float(truth.driver(p)) * truth.scale for p in places] for places in ends]
            )
        free = truth.whole and truth.closes_everywhere
        if words == self.verdict("input.free"):
            self.say("input words", free or truth.doubtful, words)
        else:
            self.say("input words", not free, words)

    def passes(self):
        truth, sheets = self.truth, self.sheets
        shown, words = sheets.of("passes"), sheets.words("passes")
        if not truth.count:
            return
        holes = truth.holes
        if truth.doubtful and not holes:
            return
        self.say("passes", (shown != 0.0) == bool(holes), shown, holes)
        if words == self.verdict("passes.all"):
            self.say("passes words", not holes, words, holes)
        elif words:
            place = numbers_in(words)
            near = [float(truth.driver(hole)) * truth.scale for hole in holes]
            step = abs(truth.step) * truth.scale
            ways = [abs(place[0] - hole) for hole in near]
            if truth.whole:  # the last row, left out, is the first
                ways += [abs(way - TURN * truth.scale) for way in ways]
            self.say("passes words", any(way <= step for way in ways), words, near)

    def gap_and_leaps(self):
        truth, sheets = self.truth, self.sheets
        gap = sheets.of("largest_gap")
        words = sheets.words("largest_gap")
        if truth.count:
            misfit = self.misfit()
            self.say("largest_gap", close(gap, misfit, 1e-9 * truth.size), gap, misfit)
            said = [self.verdict("gap.closed")] if self.fits() else self.do_not_fit()
            self.say("largest_gap words", words in said, words, misfit)
        turned = truth.turns_between_rows()
        most = math.radians(90.0)
        far = np.zeros(truth.rows - 1, dtype=bool)
        doubt = False
        for column in turned.values():
            far |= column > most
            doubt |= bool(np.any(np.abs(column - most) < 1e-6))
        shown = sheets.of("leaps")
        far &= truth.row_there[1:] & truth.row_there[:-1]
        if not doubt and not truth.holes and not truth.doubtful:
            self.say("leaps", (shown > 0) == bool(far.any()), shown, int(far.sum()))

    def misfit(self):
        return max((off for _, off in self.truth.misfits()), default=0.0)

    def fits(self):
        """Whether the lengths of redundant links are what the others ask of them."""
        return self.misfit() <= 1e-9 * self.truth.size

    def do_not_fit(self):
        """What is said of a link that does not fit; of several, any may be named."""
        links = [link for link, off in self.truth.misfits() if off > 1e-9 * self.truth.size]
        sheet, language = self.plan.at.titles["checks"], self.plan.mechanism.language
        return [self.verdict("gap.redundant", link=link_words(link).of(language), sheet=sheet) for link in links]

    # --- lines -----------------------------------------------------------------------------------------------------------

    def line(self):
        truth, sheets = self.truth, self.sheets
        line, colour = sheets.cell(VERDICT_ROW, 0), sheets.colour(VERDICT_ROW, 0)
        if self.plan.newton and line == self.verdict("same_assembly.begun"):
            return  # which assembly Newton's method has found, a search from row to row does not know
        if truth.count == 0:
            ended = self.plan.newton and line == self.verdict("line.ended")
            self.say("verdict", ended or line.startswith(self.verdict("line.nowhere")), line)
            self.say("verdict colour", colour == "red", colour)
            return
        if self.plan.newton and (lost := self.rows_off_their_trend()):
            self.say("verdict", line == self.verdict("same_assembly.lost"), line, lost)
            self.say("verdict colour", colour == "red", colour)
        elif not self.fits():
            self.say("verdict", line in self.do_not_fit(), line, self.misfit())
            self.say("verdict colour", colour == "red", colour)
        elif truth.count == truth.rows:
            missed = f"{sheets.words('task')}; " if "task" in self.plan.places.lines and sheets.of("task") > 0 else ""
            self.say("verdict", line.startswith(missed + closes_in_all(self.plan)), line)
            if not truth.doubtful:
                doubts = truth.holes or self.some_poor() or self.verdict("grashof.reach") in line or self.some_counted()
                worst = "red" if "red" in self.others() else "amber" if doubts or "amber" in self.others() else "green"
                self.say("verdict colour", colour == worst, colour, truth.holes)
        else:
            said = numbers_in(line.split(";")[0])
            self.say("verdict", sorted(said[:2]) == sorted([truth.count, truth.rows]), line, truth.count)
            if self.found.four_bars:  # of links behind the loop its type says nothing
                loop = self.found.four_bars[0]
                self.say("verdict", (loop.name in line) == (named(loop, self.plan) == loop.name), line)
            self.say("verdict colour", colour == "amber", colour)

    def some_counted(self):
        """Whether links turn far between rows, rows are dead centres, or Newton's method needs more passes than it has."""
        asked = [key for key in ("leaps", "dead_centres") if key in self.plan.places.lines]
        needed = self.sheets.words("passes_needed") if "passes_needed" in self.plan.places.lines else ""
        most = max((group.system.passes for group in self.plan.equations.groups if group.system), default=0)
        many = needed == self.verdict("passes_needed.many", passes=most)
        return many or any(self.sheets.of(key) > 0 for key in asked)

    def others(self):
        """Colours of lines of cams and tasks, which are judged elsewhere (`test_cam.py`, `test_task.py`)."""
        lines = findings_of(self.plan.mechanism, self.found)
        keys = [each.key for each in lines if type(each).__module__ in (cam.__name__, task.__name__)]
        rows = self.plan.blocks["verdicts"].rows
        return [self.sheets.colour(rows[key], MEANING) for key in keys]

    def some_poor(self):
        """Whether an angle of transmission on the sheet is below 40 degrees; the angles themselves are judged elsewhere."""
        shown = [self.sheets.of(f"transmission_{group.number}") for group in self.found.transmission]
        limit = 40.0 if self.plan.mechanism.angle_unit.in_degrees else 0.698
        return any(isinstance(angle, float) and angle < limit for angle in shown)

    def rows_off_their_trend(self):
        """Rows in which an unknown of Newton's method leaves its trend by more than 45 degrees, or behind a gap."""
        truth, off = self.truth, 0
        for group in self.plan.equations.groups:
            if group.system is None:
                continue
            largest = np.zeros(truth.rows)
            for name in group.system.variables:
                column = np.asarray(truth.at[name], float)
                most = math.radians(45.0) * (1.0 if truth.is_angle(name) else self.plan.size)
                step = np.diff(column, prepend=np.nan)
                bent = np.diff(step, prepend=np.nan)
                largest = np.maximum(largest, np.nan_to_num(np.abs(np.where(np.isnan(bent), step, bent))) / most)
            begins = truth.row_there & ~np.concatenate(([False], truth.row_there[:-1]))
            begun = np.cumsum(begins)
            off += int(np.sum(truth.row_there & np.where(begins, begun > 1, largest > 1)))
        return off

    @property
    def digit(self):
        """A unit of the last decimal in which lengths are said."""
        return 10.0 ** -decimals_of_kind(self.plan, "length")

    @staticmethod
    def bound_of(lengths, word):
        """The longest that closes, or the longest first link that turns fully."""
        ground, _, *others = lengths
        if word == "open":
            return sum(lengths) - max(lengths)
        return sum((ground, *others)) - 2 * max(ground, *others)

    def grashof(self, loop):
        truth, sheets = self.truth, self.sheets
        ground = truth.mechanism.ground
        links = (
            (ground, loop.start, loop.end),
            (loop.first, loop.start, loop.pin),
            (loop.coupler, loop.pin, loop.inner),
            (loop.last, loop.end, loop.inner),
        )
        constants = {name: float(column[0]) for name, column in truth.at.items() if truth.is_constant(name)}

        def lengths_of(known):
            return [float(number_of(distance(*link), {**constants, **known})) for link in links]

        lengths = lengths_of(truth.dimensions)
        low, high, total = min(lengths), max(lengths), sum(lengths)
        excess = 2 * (low + high) - total
        key = f"grashof_{loop.group}"
        tolerance = 1e-8 * truth.size
        self.say("grashof", close(sheets.of(key), excess, tolerance), sheets.of(key), excess)
        words = sheets.words(key)
        if self.plan.mechanism.bands is not None:  # by differences, of dimensions that none other follows from
            reach = 0.0
            for dim in toleranced(truth.mechanism):
                wide = dim.tolerance * (math.pi / 180 if dim.unit.in_degrees else 1.0)
                way = 1e-6 * wide
                value = truth.dimensions[dim.symbol]
                ends = (lengths_of({**truth.dimensions, dim.symbol: value + side * way}) for side in (1, -1))
                reach += sum(abs(high - low) for high, low in zip(*ends, strict=True)) / (2 * way) * wide
            reached = self.verdict("grashof.reach") in words
            if abs(abs(excess) - reach) > 1e-6 * reach:
                self.say("grashof words", reached == (0 < abs(excess) <= reach), words, excess, reach)
            words = words.removesuffix(self.verdict("grashof.reach"))
        near = 1e-9 * high
        index = lengths.index(low)
        ties = [i for i, length in enumerate(lengths) if abs(length - low) <= near]
        names = [None, loop.first, None, loop.last]
        if 2 * high - total > near:
            word = "open"
        elif abs(excess) <= 2 * near:
            word = "change"
        elif excess > 0:
            word = "none"
        else:
            word = ("both", "one", "coupler", "one")[index]
        link = link_words(names[index]).of(self.plan.language) if names[index] else ""
        if self.verdict("grashof.rocker") in link.split():  # a rocker that turns fully is told by its pins
            link = "".join(loop.sides(self.plan.mechanism.ground)[index][1:])
        bound = sheets.of(key, TOLERANCE)
        if word in ("open", "none") and has_advice(loop, self.plan):  # up to which length it is not
            most = self.bound_of(lengths, word)
            shown = numbers_in(str(bound).rpartition("≤")[2])
            fits = len(shown) == 1 and -1e-9 * high <= most - shown[0] <= self.digit
            if word == "none" and most < 0.1 * lengths[1]:  # a first link that short is no advice
                fits = not bound
            self.say("grashof words", fits, bound, most)
        else:
            self.say("grashof words", not bound, bound)
        begin = f"{named(loop, self.plan)}: "
        expected = begin + self.verdict(f"grashof.{word}", link=link)
        if bound:
            expected += self.verdict("grashof.enough") + bound
        doubtful = abs(abs(excess) - near) < near or (len(ties) > 1 and word in ("both", "one", "coupler"))
        if not doubtful:
            self.say("grashof words", words == expected, words, expected)

    # --- quantities ------------------------------------------------------------------------------------------------------

    def scale_of(self, symbol):
        return math.degrees(1.0) if self.plan.at.spots[symbol].degrees else 1.0

    def of_rows(self, words):
        """Whether a number is of the rows only: of several stretches or one row, where limits are known to a step, or where
        nobody looks between the rows."""
        unsettled = self.found.limits and self.verdict("within") in self.sheets.words("limits")
        stretches = self.truth.row_stretches
        rows_only = (
            len(stretches) > 1 or stretches[0][0] == stretches[0][1] or bool(unsettled) or self.plan.between_unseen
        )
        self.say("rows only", (self.verdict("rows.only") in words) == rows_only, words)
        return rows_only

    def without_bound(self, symbol, words, shown):
        """Whether the sheet says that a quantity grows without bound: then the search goes far beyond the rows."""
        if self.verdict("boundless") not in words:
            return False
        inner, outer = (self.truth.extremes(symbol, rows_only=rows_only) for rows_only in (True, False))
        beyond = not outer[2] - outer[0] < GROWN * (inner[2] - inner[0])
        self.say("without bound", missing(shown) and beyond, shown, words, inner, outer)
        return True

    def continuous(self, symbol):
        """Whether the rows follow the angle: nothing turns by half a turn or more from row to row."""
        return all(np.nanmax(column, initial=0.0) < math.pi for column in self.truth.turns_between_rows().values())

    def extent(self, key, symbol, angle):
        truth, sheets = self.truth, self.sheets
        shown, words = sheets.of(key), sheets.words(key)
        if not truth.count:
            self.say(key.split("_")[0], missing(shown), shown)
            return
        if len(truth.row_stretches) > 1:
            self.say(key.split("_")[0], missing(shown), shown)
            self.say(key.split("_")[0] + " words", words.startswith(self.verdict("swing.several")), words)
            return
        if words == self.verdict("unsure"):
            self.say("unsure", sheets.of("leaps") > 0, words)
            return
        if truth.holes or truth.doubtful:
            return  # warned of by `passes`, judged there
        low, _, high, _ = truth.extremes(symbol, rows_only=self.of_rows(words))
        range_ = high - low
        scale = self.scale_of(symbol)
        if self.without_bound(symbol, words, shown):
            return
        crank = False
        if angle and truth.whole and truth.closes_everywhere:
            column = truth.at[symbol]
            crank = abs(column[-1] - column[0]) > math.pi
        expected = (TURN if crank else range_) * scale
        about = words.endswith(self.verdict("about"))
        tolerance = (2e-2 if about else EXTREME) * expected + 1e-8 * (scale if angle else truth.size)
        kind = key.split("_")[0] + ("" if self.continuous(symbol) else " (rows too far apart)")
        self.say(kind, close(shown, expected, tolerance), shown, expected, words)
        if angle:
            word = ("crank" if crank else "rocker") if truth.whole and truth.closes_everywhere else "turned"
            self.say(kind + " words", words.startswith(self.verdict(word)), words, word)

    def ratio(self, symbol):
        truth, sheets = self.truth, self.sheets
        shown = sheets.of(f"time_ratio_{symbol}")
        goes = truth.whole and truth.closes_everywhere and truth.count == truth.rows
        if truth.doubtful or truth.holes:
            return
        if truth.mechanism.driver.uneven:
            goes = False
        if (
            truth.equations.tied and abs(truth.step) * (truth.rows - 1) > 1.5 * TURN
        ):  # gears: back after how many turns?
            goes = False
        if goes:
            column = truth.at[symbol]
            if truth.is_angle(symbol) and abs(column[-1] - column[0]) > math.pi:
                goes = False
        if not goes:
            self.say("time_ratio", missing(shown), shown)
            return
        if sheets.words(f"time_ratio_{symbol}") == self.verdict("unsure"):
            return
        low, u_low, high, u_high = truth.extremes(symbol)
        if high - low < 1e-7 * (1.0 if truth.is_angle(symbol) else truth.size):
            self.say("time_ratio", missing(shown), shown, "constant")
            return
        lows, highs = (self._ties(symbol, best) for best in (low, high))
        candidates = []
        for a in (u_low, *lows):
            for b in (u_high, *highs):
                way = (abs(b - a) * abs(truth.step)) % TURN
                if 0 < way < TURN:
                    candidates.append(max(way, TURN - way) / min(way, TURN - way))
        candidates += self._ratio_of_places(symbol, low, high)
        about = sheets.words(f"time_ratio_{symbol}").endswith(self.verdict("about"))
        right = isinstance(shown, float) and any(
            abs(shown - ratio) <= (2e-2 if about else 5e-4) * ratio for ratio in candidates
        )
        kind = "time_ratio" + ("" if self.continuous(symbol) else " (rows too far apart)")
        self.say(kind, right, shown, candidates[:3])

    def _ratio_of_places(self, symbol, low, high):
        """The ratio by the places that the sheet says, where each is as extreme as any: of flat or equal extremes."""
        truth, places = self.truth, []
        for way, best in (("min", low), ("max", high)):
            place = self.sheets.spot(f"{way}_at_{symbol}")
            there = truth.value_at(symbol, place) if isinstance(place, float) else None
            if there is None or abs(there - best) > 1e-5 * (high - low):
                return []
            places.append(place / truth.scale)
        way = abs(places[1] - places[0]) % TURN
        return [max(way, TURN - way) / min(way, TURN - way)] if 0 < way < TURN else []

    def _ties(self, symbol, best):
        truth = self.truth
        column = truth.at[symbol]
        span = np.nanmax(column) - np.nanmin(column)
        return list(truth.u[np.abs(column - best) < 2e-4 * span])[:200]

    def transmission(self, group):
        truth, sheets = self.truth, self.sheets
        key, symbol = f"transmission_{group.number}", group.transmission
        shown, words, at = sheets.of(key), sheets.words(key), sheets.of(key, TOLERANCE)
        if not truth.count or len(truth.row_stretches) > STRETCHES:
            self.say("transmission", missing(shown) and not words, shown, words)
            return
        if truth.holes or truth.doubtful or sheets.of("leaps") > 0:
            return
        several = self.of_rows(words)
        if group.kind == "RRR":

            def fold(x):
                return np.minimum(x, math.pi - x)
        else:

            def fold(x):
                return math.pi / 2 - np.abs(x)

        least, _, most, _ = truth.extremes(symbol, fold, several)
        degrees = self.plan.mechanism.angle_unit.in_degrees
        scale = math.degrees(1.0) if degrees else 1.0
        tolerance = (EXTREME * max(most - least, 1e-3) + 2e-6) * scale
        if self.verdict("about") in words:
            tolerance = 0.02 * scale
        if self.verdict("beyond") in words and isinstance(shown, float) and shown > least * scale:
            least = shown / scale
        self.say("transmission", close(shown, least * scale, tolerance), shown, least * scale, words)
        if isinstance(at, float) and isinstance(shown, float):
            there = truth.value_at(symbol, at, fold)
            self.say(
                "transmission at", there is not None and close(there * scale, shown, 10 * tolerance), at, shown, there
            )
        else:
            self.say("transmission at", False, at)
        if degrees and abs(least * scale - 40) > 1e-3:
            poor = least * scale < 40
            self.say("transmission words", (self.verdict("poor") in words) == poor, words)
            self.say("transmission words", (self.verdict("fair") in words) == (not poor and not several), words)
            colour = sheets.colour(self.plan.blocks["verdicts"].rows[key], MEANING)
            self.say("transmission colour", colour == ("amber" if poor else "" if several else "green"), colour, words)
        said = numbers_in(words.partition("(")[0])
        digits = 0.051 if degrees else 0.0051
        if self.verdict("about") in words:
            digits += 0.02 * scale
        right = len(said) == 2 and abs(said[0] - least * scale) <= digits and isinstance(at, float)
        self.say("transmission words", right and abs(said[1] - at) <= 0.051, words, least * scale, at)

    def mean(self, column):
        """Over the motion: of a turn without the row that closes it all rows count."""
        truth = self.truth
        turns = abs(truth.step) * truth.rows / TURN
        left_out = truth.mechanism.driver.link and truth.mechanism.driver.law is None and not truth.equations.tied
        if left_out and truth.row_there.all() and round(turns) > 0 and abs(turns - round(turns)) < 1e-9:
            return float(np.mean(column))
        return trapezia(column, truth.row_there)

    def summary(self, summary):
        truth, sheets = self.truth, self.sheets
        row = self.plan.blocks["summary"].rows[summary.symbol]
        shown, at = sheets.cell(row, VALUE), sheets.cell(row, TOLERANCE)
        kind = f"summary {summary.take.key}"
        words = sheets.cell(row, MEANING)
        partly = self.text("summary.part", count=truth.count, rows=truth.rows) in words
        self.say("summary words", partly == (truth.count < truth.rows), words, truth.count)
        if not truth.count:
            self.say(kind, missing(shown), shown)
            return
        if truth.holes or truth.doubtful:
            return
        if sheets.of("leaps") > 0:
            return
        extreme = summary.take.key in ("min", "max", "range") and summary.of != truth.mechanism.driver.symbol
        if extreme and len(truth.row_stretches) > STRETCHES:
            self.say(kind, missing(shown), shown)
            return
        symbol = summary.of
        if self.plan.equations.equations.range_has_gaps(symbol, summary.take) and len(truth.row_stretches) > 1:
            self.say(kind, missing(shown) and self.verdict("several") in words, shown, words)
            return
        several = extreme and self.of_rows(words)
        output = next((out for out in truth.mechanism.outputs if out.symbol == symbol), None)
        if symbol == truth.mechanism.driver.symbol:
            scale = truth.scale
        elif output is not None:
            scale = math.degrees(1.0) if output.unit.in_degrees else 1.0
        else:
            scale = self.scale_of(symbol)
        if not self.continuous(symbol) and truth.is_angle(symbol):
            return
        if len(truth.row_stretches) > 1 and truth.is_angle(symbol) and missing(shown):
            return
        column = truth.in_rows(symbol) * scale
        there = np.flatnonzero(truth.row_there)
        extremes = truth.extremes(symbol, None, several)
        if extremes is None:  # an output that does not exist
            self.say(kind, missing(shown), shown)
            return
        if extreme and self.without_bound(symbol, words, shown):
            return
        low, _, high, _ = (part * scale for part in extremes)
        range_ = high - low
        floor = 1e-8 * max(abs(high), abs(low), 1e-12) + 1e-9
        expected = {
            "min": low, "max": high, "range": range_, "mean": self.mean(column),
            "first": column[there[0]], "last": column[there[-1]],
        }[summary.take.key]  # fmt: skip
        if self.verdict("beyond") in words and isinstance(shown, float) and low < shown < high:
            expected = shown  # as far as the sheet has found; below it is judged at its place
        about = self.verdict("about") in words
        tolerance = (2e-2 if about else EXTREME) * range_ + floor
        if len(truth.row_stretches) > 1 and truth.is_angle(symbol):
            return  # turns counted anew in each stretch
        self.say(kind, close(shown, expected, tolerance), shown, expected, words)
        if summary.take.key in ("min", "max") and isinstance(at, float) and symbol != truth.mechanism.driver.symbol:
            there = truth.value_at(symbol, at)
            self.say(
                "summary at", there is not None and close(there * scale, expected, 10 * tolerance), at, there, expected
            )
