"""The words of cams in the workbook, in both languages."""

from __future__ import annotations

CAMS: dict[str, tuple[str, str]] = {
    "block.cam": ("Cam", "Kam"),
    "cam.over": ("segment {number}, {law}: angle of the cam", "{number}. parça, {law}: kam açısı"),
    "cam.by": ("segment {number}, {law}: how far the follower goes", "{number}. parça, {law}: izleyicinin yolu"),
    "cam.to": (
        "segment {number}, {law}: where the follower goes to",
        "{number}. parça, {law}: izleyicinin vardığı yer",
    ),
    "cam.begins": ("segment {number}, {law}: begins at", "{number}. parça, {law}: başladığı açı"),
    "cam.lift": ("segment {number}, {law}: lift where it begins", "{number}. parça, {law}: başındaki kalkma"),
    "cam.start": ("where the follower is on the base circle", "izleyicinin temel daire üzerindeki yeri"),
    "cam.base_radius": ("radius of the base circle", "temel dairenin yarıçapı"),
    "cam.roller": ("radius of the roller", "makaranın yarıçapı"),
    "cam.face": ("direction of the flat face in its link", "düz yüzün kendi uzvundaki yönü"),
    "cam.pressure_angle": ("largest pressure angle that is usual", "alışılmış en büyük basınç açısı"),
    "verdict.pressure_angle.fine": ("largest pressure angle: as usual", "en büyük basınç açısı: alışılmış sınırda"),
    "verdict.pressure_angle.much": (
        "largest pressure angle: more than usual, the follower may jam",
        "en büyük basınç açısı: alışılmıştan çok, izleyici sıkışabilir",
    ),
    "verdict.least_rho.fine": ("least radius of curvature of the profile", "profilin en küçük eğrilik yarıçapı"),
    "verdict.least_rho.concave": ("; hollow: largest cutter", "; içbükey: en büyük takım yarıçapı"),
    "verdict.least_rho.undercut": ("undercut: this profile cannot be made", "alttan kesilme: bu profil yapılamaz"),
    "verdict.least_rho.needed": (": a base circle of at least", ": temel daire yarıçapı en az"),
    "verdict.velocity_leaps.symbol": ("leaps of s′", "s′ sıçramaları"),
    "verdict.velocity_leaps": ("the velocity leaps, the acceleration is infinite, at", "hız sıçrar, ivme sonsuzdur:"),
    "verdict.velocity_leaps.none": ("the velocity goes without leaps", "hız sıçramasız"),
    "verdict.acceleration_leaps.symbol": ("leaps of s″", "s″ sıçramaları"),
    "verdict.acceleration_leaps": ("the acceleration leaps at", "ivme sıçrar:"),
    "verdict.acceleration_leaps.none": ("the acceleration goes without leaps", "ivme sıçramasız"),
    "segment.dwell": ("dwell", "bekleme"),
    "segment.uniform": ("uniform", "sabit hızlı"),
    "segment.parabolic": ("parabolic", "parabolik"),
    "segment.harmonic": ("harmonic", "harmonik"),
    "segment.cycloidal": ("cycloidal", "sikloidal"),
    "segment.3-4-5": ("3-4-5 polynomial", "3-4-5 polinomu"),
    "segment.4-5-6-7": ("4-5-6-7 polynomial", "4-5-6-7 polinomu"),
    "segment.modified trapezoid": ("modified trapezoid", "değiştirilmiş trapez"),
    "segment.modified sine": ("modified sine", "değiştirilmiş sinüs"),
}
