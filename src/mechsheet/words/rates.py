"""The words of velocities and accelerations in the workbook, in both languages."""

from __future__ import annotations

RATES: dict[str, tuple[str, str]] = {
    "name.speed": ("speed", "hız"),
    "name.acceleration": ("acceleration", "ivme"),
    "name.duration": ("duration", "süre"),
    "motion.start": ("first value of the driver", "tahrikin ilk değeri"),
    "motion.stop": ("last value of the driver", "tahrikin son değeri"),
    "motion.duration": ("{law}, {rows} rows", "{law}, {rows} satır"),
    "law.constant": ("constant speed", "sabit hız"),
    "law.accelerated": ("constant acceleration from rest", "durmadan sabit ivme"),
    "law.parabolic": ("parabolic motion", "parabolik hareket"),
    "law.harmonic": ("harmonic motion", "harmonik hareket"),
    "law.cycloidal": ("cycloidal motion", "sikloidal hareket"),
    "law.polynomial": ("polynomial motion 3-4-5", "3-4-5 polinom hareketi"),
    "given.t": ("time", "zaman"),
    "given.speed": ("speed of the driver", "tahrik hızı"),
    "given.acceleration": ("acceleration of the driver", "tahrik ivmesi"),
    "chart.hodograph": ("Hodograph of {points}", "{points} hodografı"),
    "drawing.hodograph.frame": ("Window of the hodograph of {points}", "{points} hodografının penceresi"),
    "drawing.pole": ("pole", "kutup"),
    "name.arrows": ("arrows", "oklar"),
    "position.show_velocity": ("draws velocities: 1 yes, 0 no", "hızları çizer: 1 evet, 0 hayır"),
    "position.show_acceleration": ("draws accelerations: 1 yes, 0 no", "ivmeleri çizer: 1 evet, 0 hayır"),
    "position.show_forces": ("draws joint forces: 1 yes, 0 no", "mafsal kuvvetlerini çizer: 1 evet, 0 hayır"),
    "arrows.velocity": ("Velocities", "Hızlar"),
    "arrows.acceleration": ("Accelerations", "İvmeler"),
    "arrows.forces": ("Joint forces", "Mafsal kuvvetleri"),
    "arrows.room": ("room taken", "aldığı yer"),
    "notes.use.arrows": (
        "Arrows in the drawing are true to scale, each kind with a bar of its own; a 0 in show_… hides a kind.",
        "Çizimdeki oklar ölçeklidir, her türün kendi ölçek çubuğu vardır; show_… hücresine 0 yazılırsa o tür gizlenir.",
    ),
    "block.motion": ("Motion of the driver", "Tahrik hareketi"),
    "motion.speed": ("speed of the driver", "tahrik hızı"),
    "motion.speed.own": ("speed of the driver, in its own unit", "tahrik hızı, kendi biriminde"),
    "motion.acceleration": ("acceleration of the driver", "tahrik ivmesi"),
    "motion.acceleration.own": ("acceleration of the driver, in its own unit", "tahrik ivmesi, kendi biriminde"),
    "rates.title": ("Velocity and acceleration", "Hız ve ivme"),
    "rates.dead": ("dead centre: {links}", "ölü konum: {links}"),
    "rates.head": ("Dead centre?", "Ölü konum mu?"),
    "block.dead": ("What the sheet of velocities says of a row", "Hız sayfasının bir satır için sözleri"),
    "checks.velocity": ("velocities fit, group {number}", "hızlar uyuyor, {number}. grup"),
    "checks.acceleration": ("accelerations fit, group {number}", "ivmeler uyuyor, {number}. grup"),
    "verdict.dead_centres": ("dead centres", "ölü konum"),
    "verdict.dead_centres.none": ("no position is a dead centre", "hiçbir konum ölü konum değil"),
    "verdict.dead_centres.some": (
        "no velocities there: see the sheet {rates}", "orada hız yok: {rates} sayfasına bakın"
    ),
    "verdict.velocities_fit": ("velocities", "hızlar"),
    "verdict.accelerations_fit": ("accelerations", "ivmeler"),
    "verdict.rates.fit": ("they fit the links: rounding only", "uzuvlarla uyuşuyor: yalnız yuvarlama"),
    "verdict.rates.not": (
        "they do not fit the links: see hidden {sheet}",
        "uzuvlarla uyuşmuyor: gizli {sheet} sayfası",
    ),
    "notes.use.rates": (
        "The sheet {rates} has the velocities and accelerations in the rows of the positions. Grey are the influence "
        "coefficients, which depend on the position alone: change {speed} or {acceleration} and the black columns follow.",
        "{rates} sayfasında, konumların satırlarında hızlar ve ivmeler vardır. Gri sütunlar yalnız konuma bağlı etki "
        "katsayılarıdır; {speed} veya {acceleration} değişince yalnız siyah sütunlar değişir.",
    ),
    "notes.assumptions.rates": (
        "Angular velocities are in rad/s and positive counter-clockwise, velocities in {unit}/s. Links that turn alike "
        "share one angular velocity. The acceleration of a sliding joint is that along its line, without Coriolis's.",
        "Açısal hızlar rad/s birimindedir, saat yönünün tersine pozitiftir; hızlar {unit}/s birimindedir. Birlikte dönen "
        "uzuvların açısal hızı birdir. Kayar mafsalın ivmesi doğrusu boyuncadır, Coriolis ivmesi bunda yoktur.",
    ),
    "notes.assumptions.coefficients": (
        "A prime is a derivative by the driver {driver}: an influence coefficient, also called kinematic. Then "
        "ω = θ′·{speed} and α = θ″·{speed}² + θ′·{acceleration}.",
        "Üs işareti, {driver} tahrikine göre türevdir: etki katsayısı. Buna göre ω = θ′·{speed}, "
        "α = θ″·{speed}² + θ′·{acceleration}.",
    ),
    "notes.assumptions.dead": (
        "At a dead centre D is 0 and velocities would be infinite: the sheet {rates} has #N/A there, the position stays.",
        "Ölü konumda D sıfırdır, hızlar sonsuz olurdu: {rates} sayfasında orada #YOK vardır; konum yerinde kalır.",
    ),
    "notes.loop": ("loop of group {number}, differentiated by time", "{number}. grubun devresi, zamana göre türevi"),
    "notes.loop.velocities": ("velocity", "hız"),
    "notes.loop.accelerations": ("acceleration", "ivme"),
}  # fmt: skip
