"""The words of masses, loads and forces in the workbook, in both languages."""

from __future__ import annotations

FORCES: dict[str, tuple[str, str]] = {
    "sheet.forces": ("Forces", "Kuvvetler"),
    "forces.title": ("Joint forces and driving torque", "Mafsal kuvvetleri ve tahrik momenti"),
    "block.masses": ("Masses", "Kütleler"),
    "block.loads": ("Loads", "Yükler"),
    "masses.mass": ("mass of link {number}, {link}", "{number} numaralı uzvun kütlesi ({link})"),
    "masses.inertia": (
        "moment of inertia of link {number}, about G",
        "{number}. uzvun kütle atalet momenti, G'ye göre",
    ),
    "masses.center": (
        "mass centre of link {number}, {axis} in its frame", "{number}. uzvun kütle merkezi, takımında {axis}"
    ),
    "masses.gravity": ("acceleration of gravity, downwards", "yerçekimi ivmesi, aşağı doğru"),
    "masses.gravity.part": ("acceleration of gravity, {axis} part", "yerçekimi ivmesi, {axis} bileşeni"),
    "loads.force": (
        "force on link {number}, {link}, {axis} part", "{number} numaralı uzva kuvvet ({link}), {axis} bileşeni"
    ),
    "loads.force.link": (
        "force on link {number}, {link}, along the link's {axis}",
        "{number} numaralı uzva kuvvet ({link}), uzvun {axis} ekseni boyunca",
    ),
    "loads.torque": ("torque on link {number}, {link}", "{number} numaralı uzva moment ({link})"),
    "loads.point": ("where it acts, {axis} in the link's frame", "etkidiği yer, uzvun takımında {axis}"),
    "loads.stiffness": ("stiffness of the spring, load {number}", "yay katsayısı, {number}. yük"),
    "loads.free_length": ("free length of the spring, load {number}", "yayın serbest boyu, {number}. yük"),
    "loads.damping": ("damping, load {number}", "sönüm katsayısı, {number}. yük"),
    "chart.effort": (
        "{symbol} against {driver}; dashed: by virtual work", "{driver} değerine göre {symbol}; kesik: virtüel iş ile"
    ),
    "checks.effort": ("effort, size", "tahrik, büyüklük"),
    "checks.force": ("largest joint force", "en büyük mafsal kuvveti"),
    "checks.torque": ("effort found twice, difference", "iki yoldan tahrik, fark"),
    "verdict.effort_fits": ("effort twice", "iki yoldan tahrik"),
    "verdict.effort.fit": (
        "reactions and virtual work agree", "tepkiler ile virtüel iş uyuşuyor"
    ),
    "verdict.effort.not": (
        "they do not agree: see hidden {sheet}", "uyuşmuyorlar: gizli {sheet} sayfasına bakın"
    ),
    "verdict.largest_effort": (
        "largest size among the rows", "satırlar içinde en büyük değeri"
    ),
    "verdict.largest_force": ("F", "F"),
    "verdict.largest_force.words": (
        "the largest joint force among the rows:", "satırlar içinde en büyük mafsal kuvveti:"
    ),
    "name.fluctuation": ("fluctuation", "dalgalanma"),
    "motion.fluctuation": (
        "of speed, allowed: (ω max − ω min)/ω mean", "hızda izin verilen: (ω_max − ω_min)/ω_ort"
    ),
    "verdict.mean_torque": ("mean torque", "ort. moment"),
    "verdict.mean_torque.words": (
        "mean over the turn: a motor with a flywheel", "bir turda ortalama: volanlı motorun verdiği"
    ),
    "verdict.energy_change.slow": ("slowest at", "en yavaş:"),
    "verdict.energy_change.fast": (", fastest at", ", en hızlı:"),
    "verdict.flywheel": ("flywheel", "volan"),
    "verdict.flywheel.words": (
        "J = ΔE/(fluctuation·ω²), on the driven shaft", "J = ΔE/(dalgalanma·ω²): mile eklenecek"
    ),
    "verdict.flywheel.missing": (
        "needs a whole turn at constant speed", "sabit hızda tam bir tur gerekir"
    ),
    "notes.use.forces": (
        "The sheet {forces} has the joint forces and the driver's effort in the rows of the positions; masses and loads are "
        "yellow cells on the first sheet. Speed 0 gives static forces.",
        "{forces} sayfasında, konumların satırlarında mafsal kuvvetleri ve tahrik vardır; kütleler ve yükler ilk sayfadaki "
        "sarı hücrelerdedir. Hız 0 ise kuvvetler statiktir.",
    ),
    "notes.assumptions.forces": (
        "F34 is the force of link 3 on link 4; a pin belongs to the link that comes first in the description. F14,n is the "
        "normal force of a slide, to the left of its line, F14,c its couple. Torques are positive counter-clockwise.",
        "F34, 3 numaralı uzvun 4 numaralı uzva kuvvetidir; mafsal, tanımda önce gelen uzvundur. F14,n kayar mafsalın normal "
        "kuvvetidir, doğrunun soluna doğru; F14,c kuvvet çiftidir. Momentler saat yönünün tersine pozitiftir.",
    ),
    "notes.assumptions.rigid": (
        "Links are rigid; there is no friction, no clearance, no impact. The motion is given, the effort is what it needs.",
        "Uzuvlar rijittir; sürtünme, boşluk ve darbe yoktur. Hareket verilmiştir, tahrik bunun gerektirdiğidir.",
    ),
}  # fmt: skip
