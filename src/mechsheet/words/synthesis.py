"""The words of synthesis, in both languages: of tasks, of the steps of their solutions, of what is said of these."""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.model import Words

STEPS: dict[str, tuple[str, str]] = {
    # tasks
    "a1": ("ground A0B0", "sabit uzuv A0B0"),
    "theta": ("input angle at point {number}", "{number}. noktada giriş açısı"),
    "psi": ("output angle at point {number}", "{number}. noktada çıkış açısı"),
    "theta.end": ("input angle where x is {end}", "x {end} iken giriş açısı"),
    "psi.end": ("output angle where x is {end}", "x {end} iken çıkış açısı"),
    "x": ("x, {end}", "x, {end}"),
    "round": ("lengths are rounded to this", "uzunluklar buna yuvarlanır"),
    "stroke": ("stroke", "kurs"),
    "time_ratio": ("time ratio", "zaman oranı"),
    "crank": ("crank", "krank"),
    # function generation
    "cos_theta": ("cosine of the input angle {number}", "{number}. giriş açısının kosinüsü"),
    "cos_psi": ("cosine of the output angle {number}", "{number}. çıkış açısının kosinüsü"),
    "cos_difference": ("cosine of their difference", "farklarının kosinüsü"),
    "determinant": ("determinant: 0 where the points decide nothing", "determinant: noktalar yetersizse 0"),
    "k1": ("a1/a2", "a1/a2"),
    "k2": ("a1/a4", "a1/a4"),
    "k3": ("(a1² + a2² − a3² + a4²)/(2 a2 a4)", "(a1² + a2² − a3² + a4²)/(2 a2 a4)"),
    "mean_theta": ("mean of cos θ", "cos θ ortalaması"),
    "mean_psi": ("mean of cos ψ", "cos ψ ortalaması"),
    "mean_difference": ("mean of cos(θ − ψ)", "cos(θ − ψ) ortalaması"),
    "sum_of_products": ("Σ ({one} − mean)({other} − mean)", "Σ ({one} − ortalama)({other} − ortalama)"),
    "a2_signed": ("input with its sign: below 0 its angle is 180° off", "işaretiyle giriş uzvu: eksiyse açısı 180° ötede"),
    "a4_signed": ("output with its sign: below 0 its angle is 180° off", "işaretiyle çıkış uzvu: eksiyse açısı 180° ötede"),
    "a3_squared": ("coupler squared: below 0 there is none", "biyelin karesi: eksiyse biyel yoktur"),
    "a2": ("input A0A", "giriş uzvu A0A"),
    "a3": ("coupler AB", "biyel AB"),
    "a4": ("output B0B", "çıkış uzvu B0B"),
    "theta_offset": ("link angle of the input less θ", "giriş uzvunun açısı eksi θ"),
    "psi_offset": ("link angle of the output less ψ", "çıkış uzvunun açısı eksi ψ"),
    "side": ("side of A→B0 on which B lies, point {number}", "{number}. noktada B, A→B0'ın hangi yanında"),
    "mode": ("assembly that meets the points", "noktalardan geçen montaj"),
    "f_at_end": ("f where x is {end}", "x {end} iken f"),
    "f_at": ("f at point {number}", "{number}. noktada f"),
    "chebyshev": ("x at point {number}, Chebyshev's spacing", "{number}. noktada x, Çebişev aralığı"),
    "theta_scaled": ("input angle at point {number}", "{number}. noktada giriş açısı"),
    "psi_scaled": ("output angle at point {number}", "{number}. noktada çıkış açısı"),
    # why there is no solution, by the first step that has no value
    "none.k1": (
        "no solution: the points do not decide it (two are equal, or they lie on one line)",
        "çözüm yok: noktalar yetmiyor (ikisi aynı ya da hepsi bir doğru üzerinde)",
    ),
    "none.a2_signed": ("no solution: the input would be infinitely long", "çözüm yok: giriş uzvu sonsuz uzun olurdu"),
    "none.a4_signed": ("no solution: the output would be infinitely long", "çözüm yok: çıkış uzvu sonsuz uzun olurdu"),
    "none.a3": ("no coupler: the points cannot be met", "biyel yok: bu noktalardan geçilemez"),
    "none.theta_scaled": ("no solution: the range of x has no length", "çözüm yok: x aralığının boyu yok"),
    "none.psi_scaled": ("no solution: f is the same at both ends", "çözüm yok: f iki uçta aynı"),
    "none.f_at_end": ("no solution: f has no value at an end", "çözüm yok: f bir uçta tanımsız"),
    "none.f_at": ("no solution: f has no value at a point", "çözüm yok: f bir noktada tanımsız"),
    "none.centre": (
        "no solution: the time ratio must be greater than 1", "çözüm yok: zaman oranı 1'den büyük olmalı"
    ),
    # quick returns
    "turn_back": ("turn of the crank on the way back", "geri dönüşte krankın dönmesi"),
    "half_swing": ("half the swing of the lever", "kol salınımının yarısı"),
    "swing": ("swing of the lever", "kolun salınımı"),
    "centre": ("distance of the pivots", "sabit mafsalların uzaklığı"),
    "lever": ("length of the lever", "kolun boyu"),
    "whitworth_offset": ("Whitworth: distance of the pivots", "Whitworth: sabit mafsalların uzaklığı"),
}  # fmt: skip
"""Key -> English and Turkish, with the names of their parts."""

ENDS = (Words("first", "ilk"), Words("last", "son"))

SHEET: dict[str, tuple[str, str]] = {
    "sheet.synthesis": ("Synthesis", "Sentez"),
    "synthesis.kind.function": ("Synthesis of a function generator", "Fonksiyon üreteci sentezi"),
    "synthesis.kind.quick-return-lever": (
        "Synthesis of a quick return with a lever", "Kollu çabuk dönüş mekanizmasının sentezi"
    ),
    "synthesis.hint": (
        "Type into the yellow cells: lengths, drawing and curves follow at once.",
        "Sarı hücrelere yazın: boylar, çizim ve eğriler hemen uyar.",
    ),
    "synthesis.task": ("Task", "Ödev"),
    "synthesis.result": ("Result", "Sonuç"),
    "synthesis.solution": ("Solution, step by step", "Adım adım çözüm"),
    "synthesis.does": ("Does it do it?", "Yapıyor mu?"),
    "synthesis.does.unsolved": ("solution", "çözüm"),
    "synthesis.exact": ("exact", "tam"),
    "synthesis.rounded": ("rounded", "yuvarlanmış"),
    "synthesis.used": ("used", "kullanılan"),
    "synthesis.solved": ("the task has a solution", "ödevin çözümü var"),
    "synthesis.nothing": ("no solution", "çözüm yok"),
    "synthesis.from": ("from the synthesis", "sentezden"),
}  # fmt: skip
"""The words of the sheet, likewise."""


def step_words(key: str, **parts: object) -> Words:
    """What an input of a task or a step of its solution is, its {parts} filled in; words are parts in each language."""
    en, tr = STEPS[key]
    return Words(_filled(en, parts, "en"), _filled(tr, parts, "tr"))


def _filled(text: str, parts: Mapping[str, object], language: str) -> str:
    spelt = {name: part.of(language) if isinstance(part, Words) else part for name, part in parts.items()}
    return text.format(**spelt)
