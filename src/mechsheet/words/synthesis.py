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
    "length_at_pose": ("{start}{end} at pose {number}", "{number}. konumda {start}{end}"),
    "stroke": ("stroke", "kurs"),
    "time_ratio": ("time ratio", "zaman oranı"),
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
    # crank-rockers by their dead centres
    "swing_given": ("swing of the rocker", "sarkacın salınım açısı"),
    "turn": ("turn of the crank on the slow way", "yavaş gidişte krankın dönmesi"),
    "domain": ("within its limits above 0", "sınırları içindeyse 0'dan büyük"),
    "less_cosine": ("1 − cos, for short", "1 − cos, kısaca"),
    "more_cosine": ("1 + cos, for short", "1 + cos, kısaca"),
    "lam": ("coupler over crank, a3/a2", "biyel/krank oranı, a3/a2"),
    "lam_squared": ("its square", "karesi"),
    "lam_from_crank": ("coupler over crank, a3/a2", "biyel/krank oranı, a3/a2"),
    "best_lam": ("the a3/a2 with the best transmission", "bağlama açısı en iyi olan a3/a2"),
    "t_squared": ("t², t = tan(φ/2)", "t², t = tan(φ/2)"),
    "u_squared": ("u², u = tan((φ − ψ)/2)", "u², u = tan((φ − ψ)/2)"),
    "cubic_b": ("cubic: factor of the square", "kübik denklem: karenin katsayısı"),
    "cubic_c": ("cubic: factor of the unknown", "kübik denklem: bilinmeyenin katsayısı"),
    "cubic_d": ("cubic: constant", "kübik denklem: sabit"),
    "depressed": ("cubic without its square", "karesiz kübik denklem"),
    "discriminant": ("its discriminant", "diskriminantı"),
    "cardano": ("Cardano's cube root", "Cardano'nun küp kökü"),
    "depressed_root": ("its root", "kökü"),
    "cubic_root": ("root of the cubic", "kübik denklemin kökü"),
    "cubic_newton": ("the same to the last digit, by Newton", "aynısı, Newton adımıyla son basamağa kadar"),
    "D": ("D", "D"),
    "crank": ("crank A0A", "krank A0A"),
    "coupler": ("coupler AB", "biyel AB"),
    "rocker": ("rocker B0B", "sarkaç B0B"),
    "kappa": ("(1 − λ)/(1 + λ)", "(1 − λ)/(1 + λ)"),
    "numerator": ("for the first dead centre", "birinci ölü konum için"),
    "denominator": ("for the first dead centre", "birinci ölü konum için"),
    "rocker_part": ("B0→B at the first dead centre, over a1", "birinci ölü konumda B0→B, a1 cinsinden"),
    "theta_1": ("crank angle, first dead centre", "birinci ölü konumda krank açısı"),
    "psi_1": ("rocker angle, first dead centre", "birinci ölü konumda sarkaç açısı"),
    "together": ("above 0: one assembly has both dead centres", "0'dan büyükse iki ölü konum aynı montajda"),
    "mode_dead": ("assembly with both dead centres", "iki ölü konumu da olan montaj"),
    "cos_mu_near": ("cos μ, crank towards B0", "cos μ, krank B0'a doğru"),
    "cos_mu_far": ("cos μ, crank away from B0", "cos μ, krank B0'dan öteye"),
    "cos_mu": ("the larger of them", "büyük olanı"),
    "mu_min": ("least transmission angle", "en küçük bağlama açısı"),
    # eccentric slider-cranks
    "alpha": ("angle between the dead centres", "ölü konumlar arasındaki açı"),
    "rod": ("connecting rod AB", "biyel AB"),
    "eccentricity": ("eccentricity", "eksantriklik"),
    "slider_together": ("above 0: one assembly has both dead centres", "0'dan büyükse iki ölü konum aynı montajda"),
    "cos_mu_slider": ("cosine of the least transmission angle", "en küçük bağlama açısının kosinüsü"),
    # guidance through poses
    "pose_x": ("pose {number}: x of the body", "{number}. konum: cismin x'i"),
    "pose_y": ("pose {number}: y of the body", "{number}. konum: cismin y'si"),
    "pose_angle": ("pose {number}: angle of the body", "{number}. konum: cismin açısı"),
    "turn_of_body": ("turn of the body to pose {number}", "{number}. konuma kadar cismin dönmesi"),
    "moving": ("{point} of the body at pose 1, {axis}", "1. konumda cismin {point} noktası, {axis}"),
    "fixed": ("fixed pivot {point}, {axis}", "sabit mafsal {point}, {axis}"),
    "beta": ("turn of the crank at {point} to pose {number}", "{number}. konuma kadar {point} kolunun dönmesi"),
    "place": ("{point} at pose {number}, {axis}", "{number}. konumda {point}, {axis}"),
    "seen": ("{point} seen from the body at pose {number}, {axis}", "{number}. konumda cisimden görülen {point}, {axis}"),
    "chord": ("chord 1→{number}, {axis}", "1→{number} kirişi, {axis}"),
    "half_square": ("half the chord's square", "kirişin karesinin yarısı"),
    "circle_determinant": ("0 where the three places lie on a line", "üç yer bir doğru üzerindeyse 0"),
    "fixed_pivot": ("fixed pivot {point}, {axis}", "sabit mafsal {point}, {axis}"),
    "moving_pivot": ("moving pivot {point} at pose 1, {axis}", "1. konumda hareketli mafsal {point}, {axis}"),
    "turn_vector": ("e^(iβ) − 1, pose {number}, {axis}", "e^(iβ) − 1, {number}. konum, {axis}"),
    "body_vector": ("e^(iα) − 1, pose {number}, {axis}", "e^(iα) − 1, {number}. konum, {axis}"),
    "turns_det": ("determinant, {axis}", "determinant, {axis}"),
    "turns_square": ("its square: 0 where the turns decide nothing", "karesi: dönmeler yetmezse 0"),
    "turns_numerator": ("for {vector}, {axis}", "{vector} için, {axis}"),
    "arm": ("W: fixed to moving pivot, {axis}", "W: sabit mafsaldan hareketliye, {axis}"),
    "rest": ("Z: moving pivot to the body's point, {axis}", "Z: hareketli mafsaldan cismin noktasına, {axis}"),
    "length_of": ("{start}{end}", "{start}{end}"),
    "crank_angle": ("crank angle at pose 1", "1. konumda krank açısı"),
    "coupler_angle": ("direction A→B at pose 1", "1. konumda A→B doğrultusu"),
    "body_in_coupler": ("the body's point on the coupler, {axis}", "biyel üzerinde cismin noktası, {axis}"),
    "side_pose": ("side of A→B0 on which B lies, pose {number}", "{number}. konumda B, A→B0'ın hangi yanında"),
    "mode_poses": ("assembly that meets the poses", "konumlardan geçen montaj"),
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
    "none.less_cosine": (
        "no solution: φ must lie between 90° + ψ/2 and 270° + ψ/2, ψ between 0° and 180°",
        "çözüm yok: φ 90° + ψ/2 ile 270° + ψ/2, ψ 0° ile 180° arasında olmalı",
    ),
    "none.t_squared": (
        "no best λ: μ min rises with λ towards 90° − ψ/4; give λ or a2",
        "en iyi λ yok: λ büyüdükçe μ min artar; λ ya da a2 verin",
    ),
    "none.lam_from_crank": (
        "no solution: no coupler longer than this crank", "çözüm yok: bu kranktan uzun bir biyel bulunamaz"
    ),
    "none.best_lam": ("no best λ: give λ or a2", "en iyi λ yok: λ ya da a2 verin"),
    "none.D": ("no solution: λ must be greater than 1", "çözüm yok: λ 1'den büyük olmalı"),
    "none.cubic_b": (
        "no best λ: the time ratio must lie between 1/3 and 3 and not be 1",
        "en iyi λ yok: zaman oranı 1/3 ile 3 arasında, 1'den başka olmalı",
    ),
    "none.rod": ("no solution: λ must be greater than 1", "çözüm yok: λ 1'den büyük olmalı"),
    "none.fixed_pivot": (
        "no such link: the three places lie on a line (a slider would do)",
        "böyle bir uzuv yok: üç yer bir doğru üzerinde (bir kızak olurdu)",
    ),
    "none.moving_pivot": (
        "no such link: the three places lie on a line (a slider would do)",
        "böyle bir uzuv yok: üç yer bir doğru üzerinde (bir kızak olurdu)",
    ),
    "none.arm": ("no solution: the turns decide nothing", "çözüm yok: dönmeler yetmiyor"),
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
    "synthesis.kind.dead-centres": (
        "Synthesis of a crank-rocker by its dead centres", "Ölü konumlarıyla krank-sarkaç sentezi"
    ),
    "synthesis.kind.guidance": ("Synthesis of a body's guidance", "Cisim kılavuzlama sentezi"),
    "synthesis.kind.quick-return-slider": (
        "Synthesis of a quick return with a slider", "Krank-biyelli çabuk dönüş mekanizmasının sentezi"
    ),
    "synthesis.hint": (
        "Type into the yellow cells: lengths, drawing and curves follow at once.",
        "Sarı hücrelere yazın: boylar, çizim ve eğriler hemen uyar.",
    ),
    "synthesis.task": ("Task", "Görev"),
    "synthesis.result": ("Result", "Sonuç"),
    "synthesis.solution": ("Solution, step by step", "Adım adım çözüm"),
    "synthesis.does": ("Does it do it?", "Yapıyor mu?"),
    "synthesis.does.unsolved": ("solution", "çözüm"),
    "synthesis.does.task_inputs": ("yellow cells", "sarı hücre"),
    "synthesis.inputs.fine": ("all hold possible values", "hepsinde olabilecek bir değer var"),
    "synthesis.does.meets": ("task", "görev"),
    "synthesis.does.assemblies": ("assemblies", "montaj sayısı"),
    "synthesis.does.order": ("order", "sıra"),
    "synthesis.does.closes_throughout": ("passes", "geçiş"),
    "synthesis.does.transmission_used": ("least μ", "en küçük μ"),
    "synthesis.does.transmission_least": ("least μ", "en küçük μ"),
    "synthesis.does.at_dead_centre": ("dead centre", "ölü konum"),
    "synthesis.does.grashof": ("Grashof", "Grashof"),
    "synthesis.does.sensitivity": ("sensitivity", "duyarlık"),
    "synthesis.does.together": ("dead centres", "ölü konumlar"),
    "synthesis.does.turns": ("full turn", "tam dönme"),
    "synthesis.does.all": ("does all that the task asks", "görevin istediği her şeyi yapıyor"),
    "synthesis.meets.exactly": ("does exactly what is asked", "isteneni tam olarak yapıyor"),
    "synthesis.meets.about": ("misses what is asked by up to ", "istenenden en çok sapma: "),
    "synthesis.meets.rounded": (
        "rounded, it does not reach what is asked; exact it does",
        "yuvarlanınca istenene ulaşamıyor; tam boylarla ulaşıyor",
    ),
    "synthesis.meets.not": ("does not reach what is asked", "istenene ulaşamıyor"),
    "synthesis.assemblies.one": ("all points on one assembly", "bütün noktalar aynı montajda"),
    "synthesis.assemblies.both": ("points on both assemblies:", "noktalar iki montajda:"),
    "synthesis.assemblies.other": ("the mechanism is of the other assembly", "mekanizma öbür montajda"),
    "synthesis.order.kept": ("goes through the points in their order", "noktalardan sırasıyla geçiyor"),
    "synthesis.order.not": ("goes through the points in another order", "noktalardan başka bir sırayla geçiyor"),
    "synthesis.closes_throughout.all": ("passes the whole range", "bütün aralıktan geçiyor"),
    "synthesis.closes_throughout.not": (
        "a dead centre between the points: it cannot pass", "noktalar arasında ölü konum var: geçemiyor"
    ),
    "synthesis.transmission.good": ("good transmission", "bağlama iyi"),
    "synthesis.transmission.poor": ("poor transmission: below 40°", "bağlama kötü: 40°'nin altında"),
    "synthesis.at_dead_centre.yes": ("a point lies at a dead centre", "bir nokta ölü konumda"),
    "synthesis.at_dead_centre.no": ("no point at a dead centre", "hiçbir nokta ölü konumda değil"),
    "synthesis.together.both": ("one assembly has both dead centres", "iki ölü konum aynı montajda"),
    "synthesis.together.not": (
        "the dead centres lie on both assemblies: no such motion", "ölü konumlar iki ayrı montajda: böyle bir hareket yok"
    ),
    "synthesis.turns.fully": ("the crank turns fully", "krank tam döner"),
    "synthesis.turns.not": ("the crank does not turn fully", "krank tam dönmez"),
    "synthesis.turns.rounded": (
        "no full turn once rounded; exact it has to spare ",
        "yuvarlanınca tam dönmez; tam boylarla payı ",
    ),
    "synthesis.grashof.rounded": (
        "; exact: the input turns fully", "; tam boylarla giriş uzvu tam döner"
    ),
    "synthesis.sensitivity.about": (
        "0.1° (or 0.1 %) in an input changes a length by up to ",
        "girdide 0,1° (ya da %0,1) bir boyu değiştirir, en çok: ",
    ),
    "synthesis.asked": ("What is asked", "İstenenler"),
    "synthesis.wanted": ("wanted", "istenen"),
    "synthesis.got": ("got", "elde edilen"),
    "synthesis.got.turns": ("got, but for whole turns", "elde edilen, tam tur farkıyla"),
    "synthesis.error": ("error", "hata"),
    "synthesis.error.exact": ("exact: error", "tam boylarla hata"),
    "synthesis.figure": ("Figure", "Şekil"),
    "synthesis.figure.window.x": ("middle, x", "orta, x"),
    "synthesis.figure.window.y": ("middle, y", "orta, y"),
    "synthesis.figure.window.half": ("half its side", "yarı kenar"),
    "synthesis.figure.dead": ("dead centre {number}", "{number}. ölü konum"),
    "synthesis.figure.crank": ("crank {number}", "{number}. krank"),
    "synthesis.figure.swing": ("swing", "salınım"),
    "synthesis.figure.guide": ("guide", "kızak"),
    "synthesis.figure.pose": ("pose {number}", "{number}. konum"),
    "synthesis.figure.body": ("body {number}", "{number}. cisim"),
    "synthesis.figure.point": ("point {number}", "{number}. nokta"),
    "synthesis.figure.points": ("points", "noktalar"),
    "synthesis.figure.function": ("At the points", "Noktalarda"),
    "synthesis.figure.dead-centres": ("Both dead centres", "İki ölü konum"),
    "synthesis.figure.guidance": ("The three poses", "Üç konum"),
    "synthesis.figure.quick-return-slider": ("Both dead centres", "İki ölü konum"),
    "synthesis.figure.quick-return-lever": ("Both dead centres", "İki ölü konum"),
    "synthesis.curve": ("Curve", "Eğri"),
    "synthesis.curve.theta": ("θ", "θ"),
    "synthesis.curve.wanted": ("ψ wanted", "istenen ψ"),
    "synthesis.curve.raw": ("ψ", "ψ"),
    "synthesis.curve.got": ("ψ got", "elde edilen ψ"),
    "synthesis.curve.mu": ("μ", "μ"),
    "synthesis.curve.lam": ("λ", "λ"),
    "synthesis.curve.crank": ("a2", "a2"),
    "synthesis.curve.rocker": ("a4, c", "a4, c"),
    "synthesis.curve.least": ("for cos μ", "cos μ için"),
    "synthesis.curve.here": ("solution", "çözüm"),
    "synthesis.curve.axis.theta": ("θ", "θ"),
    "synthesis.curve.axis.got": ("ψ", "ψ"),
    "synthesis.curve.axis.mu": ("μ", "μ"),
    "synthesis.curve.axis.lam": ("λ = a3/a2", "λ = a3/a2"),
    "synthesis.curve.title.function": ("Output angle: wanted and got", "Çıkış açısı: istenen ve elde edilen"),
    "synthesis.curve.title.guidance": ("Transmission angle between the poses", "Konumlar arasında bağlama açısı"),
    "synthesis.curve.title.dead-centres": ("Least transmission angle over λ", "λ'ya göre en küçük bağlama açısı"),
    "synthesis.curve.title.quick-return-slider": (
        "Least transmission angle over λ", "λ'ya göre en küçük bağlama açısı"
    ),
    "synthesis.exact": ("exact", "tam"),
    "synthesis.rounded": ("rounded", "yuvarlanmış"),
    "synthesis.used": ("used", "kullanılan"),
    "synthesis.solved": ("the task has a solution", "görevin çözümü var"),
    "synthesis.nothing": ("no solution", "çözüm yok"),
    "synthesis.from": ("from the synthesis", "sentezden"),
    "sheet.alt": ("Alt’s chart", "Alt diyagramı"),
    "alt.title": (
        "Alt’s chart: the best least transmission angle of crank-rockers",
        "Alt diyagramı: krank-sarkaçların en iyi en küçük bağlama açısı",
    ),
    "alt.hint": (
        "Over the swing ψ of the rocker and the turn φ of the crank meanwhile; last row and column: the task’s. "
        "Green: 40° or more. Grey: no best λ (at φ = 180° μ min rises with λ towards 90° − ψ/4), or no crank-rocker.",
        "Sarkacın salınım açısı ψ ile krankın bu sırada dönmesi φ üzerinden; son satır ve sütun görevinkiler. "
        "Yeşil: 40° ve üstü. Gri: en iyi λ yok (φ = 180°'de λ büyüdükçe μ min 90° − ψ/4'e doğru artar) "
        "ya da krank-sarkaç yok.",
    ),
    "alt.angles": ("μ min [°]", "μ min [°]"),
    "alt.ratios": ("λ = a3/a2", "λ = a3/a2"),
    "alt.swing": ("ψ [°] →", "ψ [°] →"),
    "alt.turn": ("φ [°] ↓", "φ [°] ↓"),
    "alt.task": ("φ of the task", "görevin φ'si"),
    "alt.own": ("this mechanism", "bu mekanizma"),
    "alt.line.best": ("The best for this task: μ min = ", "Bu görev için en iyisi: μ min = "),
    "alt.line.own": ("; this mechanism: ", "; bu mekanizma: "),
    "alt.line.none": (
        "no best λ for the swing ψ and the turn φ of this task", "bu görevin ψ ve φ açıları için en iyi λ yok"
    ),
}  # fmt: skip
"""The words of the sheet, likewise."""


def step_words(key: str, **parts: object) -> Words:
    """What an input of a task or a step of its solution is, its {parts} filled in; words are parts in each language."""
    en, tr = STEPS[key]
    return Words(_filled(en, parts, "en"), _filled(tr, parts, "tr"))


def _filled(text: str, parts: Mapping[str, object], language: str) -> str:
    spelt = {name: part.of(language) if isinstance(part, Words) else part for name, part in parts.items()}
    return text.format(**spelt)
