"""Symbols as people write them: Greek letters and subscripts (theta13 is θ with subscript 13), wherever they stand."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Delta": "Δ", "Gamma": "Γ", "Theta": "Θ", "Phi": "Φ",
    "Psi": "Ψ", "Omega": "Ω", "Sigma": "Σ", "lam": "λ",
}  # fmt: skip

_PRIMES = {"d": "′", "dd": "″", "ddd": "‴"}
_DOTS = {"v": "\u0307", "a": "\u0308"}
"""Derivatives by the driver, and by time."""

_DISPLACEMENT = re.compile(r"s[0-9_]*")

_FORCE = re.compile(r"([FT])([0-9]+|[0-9]+_[0-9]+)\.(x|y|n|c|t|work)")
_PASS = re.compile(r" (n|[0-9]+)$")
"""Behind the symbol of a quantity within a pass of Newton's method."""
_SHAKING = {"shaking.x": ("F", "s,x"), "shaking.y": ("F", "s,y"), "shaking.m": ("M", "s")}

SQUARED = "²"
"""Behind the symbol of a quantity's square."""

_PARTS = re.compile(r"([^\W\d_]+)_?(.*)", re.DOTALL)


@lru_cache(maxsize=4096)
def parts(symbol: str) -> tuple[str, str]:
    """(letter, subscript): theta13 -> (θ, 13), a2 -> (a, 2), C.x -> (x, C), phi_2 -> (φ, 2), A0B0 stays whole.

    theta13.d -> (θ′, 13), C.x.dd -> (x″, C), s14.v -> (ṡ, 14), C.vx -> (v, C,x), F34.x -> (F, 34,x), F14.n -> (F, 14,n),
    T12² -> (T², 12)
    """
    if symbol.startswith(("Σ|", "√Σ")):
        return symbol, ""
    if ":" in symbol:
        return _of_band(*symbol.split(":"))
    if symbol.endswith(SQUARED):
        letter, subscript = parts(symbol.removesuffix(SQUARED))
        return letter + SQUARED, subscript
    symbol = _PASS.sub("", symbol)
    if symbol in _SHAKING:
        return _SHAKING[symbol]
    force = _FORCE.fullmatch(symbol)
    if force:
        letter, numbers, part = force.groups()
        numbers = numbers.replace("_", ",")
        return letter, numbers + "*" if part == "work" else f"{numbers},{part}"
    whole, dot, order = symbol.rpartition(".")
    if dot and order in _PRIMES:
        letter, subscript = parts(whole)
        return letter + _PRIMES[order], subscript
    point, dot, axis = symbol.partition(".")
    if dot and axis in _DOTS and _DISPLACEMENT.fullmatch(point):
        letter, subscript = parts(point)
        return unicodedata.normalize("NFC", letter + _DOTS[axis]), subscript
    if dot and axis == "j" and point.startswith("theta"):  # the jerk, beside ω and α of the same link
        return axis, parts(point)[1]
    if dot and len(axis) == 2:
        return axis[0], f"{point},{axis[1]}"
    if dot:
        return axis, point
    match = _PARTS.fullmatch(symbol)
    if not match:
        return symbol, ""
    letter, subscript = match.groups()
    subscript = subscript.strip("_").replace("_", ",")
    greek = GREEK.get(letter)
    if greek is None and any(character.isalpha() for character in subscript) and "_" not in symbol:
        return symbol, ""
    return greek or letter, subscript


def _of_band(quantity: str, part: str) -> tuple[str, str]:
    """det:1 -> (D, 1), theta14:gap 1.x -> (λ, 1,x), theta14:a3 -> ∂θ₁₄/∂a₃, theta14:worst case -> (Δθ, 14)"""
    if quantity == "det":
        return "D", part
    what, space, number = part.partition(" ")
    if quantity.startswith("loop "):
        return f"∂g{quantity.removeprefix('loop ')}/∂{plain(part)}", ""
    if not space:
        return f"∂{plain(quantity)}/∂{plain(part)}", ""
    if what in ("gap", "part"):
        return "λ" if what == "gap" else "Σ", number.replace(".", ",")
    letter, subscript = parts(quantity)
    return f"Δ{letter}", subscript


_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def plain(symbol: str) -> str:
    """The symbol where no formatting is possible (chart titles): θ₁₃, T₁₂*, F₁₄ₙ, x_C."""
    letter, subscript = parts(symbol)
    if not subscript:
        return letter
    if subscript.rstrip("*").isdigit():
        return letter + subscript.translate(_SUBSCRIPTS)
    if subscript.removesuffix(",n").isdigit():
        return letter + subscript.replace(",n", "ₙ").translate(_SUBSCRIPTS)
    return f"{letter}_{subscript}"
