"""What the list of shapes asks of a mechanism and its equations."""

from __future__ import annotations

from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import Equations
from mechsheet.model import Link, Mechanism
from mechsheet.shapes.colors import link_color
from mechsheet.shapes.points import pins_of
from mechsheet.words.catalogue import words
from mechsheet.words.equations import link_words


class Described:
    """A mechanism, its equations, and what shapes ask of both."""

    def __init__(self, mechanism: Mechanism, equations: Equations) -> None:
        self.mechanism, self.equations = mechanism, equations
        self.dimensions = dimension_values(mechanism)
        self.links = {link.name: link for link in mechanism.links}
        self.driven = mechanism.driven_link
        self.pins = pins_of(mechanism)

    @property
    def ground(self) -> Link:
        """The fixed link."""
        return self.mechanism.ground

    def text(self, key: str, **parts: object) -> str:
        """A word of the drawing in the mechanism's language."""
        return words(self.mechanism.language, key, **parts)

    def called(self, link: Link) -> str:
        """What people call a link."""
        return link_words(link).of(self.mechanism.language)

    def color(self, link: str) -> str:
        """The colour of a link."""
        return link_color(self.links[link], self.driven)
