"""Of cams: segments of motion, what the profile touches."""

from __future__ import annotations

CAMS: dict[str, str] = {
    "a base circle says it where the ground carries a slide, or a rocker with a roller": (
        "sabit uzvun taşıdığı bir kızakta ya da makaralı sarkaçta bunu temel daire söyler"
    ),
    "a cam turns once: give rows or step": "kam bir kez döner: ya satır sayısını ya adımı verin",
    "a dwell goes nowhere": "bekleme hiçbir yere gitmez",
    "a motion that does not close ends where its segments end: write another step in [driver]": (
        "kapanmayan hareket parçalarının bittiği yerde biter: [driver] içinde başka bir adım yazın"
    ),
    "a radius is not negative; 0 is a knife edge": "yarıçap eksi olmaz; 0 bıçak ağızdır",
    "a segment goes over an angle greater than 0": "bir parça 0'dan büyük bir açı boyunca sürer",
    "by and to exclude each other": "by ile to birlikte verilmez",
    "by or to is missing: how far it goes": "by ya da to eksik: ne kadar gittiği",
    "leave `over` out of the last one: what is left of the turn": (
        "sonuncusunda `over` yazmayın: turdan geriye kalandır"
    ),
    "leave {key} out": "{key} yazmayın",
    "nothing is left of the turn: the segments before end at {end:.6g}°": (
        "turdan bir şey kalmıyor: önceki parçalar {end:.6g}° açısında bitiyor"
    ),
    "over is missing: over which angle of the cam the segment goes": "over eksik: parçanın sürdüğü kam açısı",
    "rename it: the cam's motion has a cell of that name": "adını değiştirin: kam hareketinin bu adda bir hücresi var",
    "start is missing: where the follower is on the base circle": "start eksik: izleyicinin temel daire üzerindeki yeri",
    "the face is nowhere tangent to the cam: it lies along the way of the slide": (
        "yüz kama hiçbir yerde teğet değil: kızağın yolu boyunca uzanıyor"
    ),
    "the face is on the ground: the cam could not move it": "yüz sabit uzuvda: kam onu hareket ettiremez",
    "the follower does not come back: it ends {end:.6g} from where it began": (
        "izleyici geri dönmüyor: başladığı yerden {end:.6g} uzakta bitiyor"
    ),
    "the follower never moves: every segment is a dwell": "izleyici hiç hareket etmiyor: bütün parçalar bekleme",
    "the radius of the base circle must be greater than 0": "temel dairenin yarıçapı 0'dan büyük olmalı",
    "the rocker's roller never touches a base circle of this radius": (
        "sarkacın makarası bu yarıçapta bir temel daireye hiç değmez"
    ),
    "the segments end at {end:.6g}°, not at 360°": "parçalar 360° değil {end:.6g}° açısında bitiyor",
    "the segments leave the turn: they end at {end:.6g}°": "parçalar turdan taşıyor: {end:.6g}° açısında bitiyorlar",
    "the slide passes the centre at {offset:.6g}: a base circle of {radius:.6g} does not reach it": (
        "kızak merkezden {offset:.6g} uzakta geçiyor: {radius:.6g} yarıçaplı temel daire ona ulaşmaz"
    ),
    "they must end before 360°": "360°'den önce bitmeleri gerekir",
    "write to = 0, or closed = false in [driver]": "to = 0 ya da [driver] içinde closed = false yazın",
    "{name} is a point of the ground: the cam could not move a roller there": (
        "{name} sabit uzvun noktası: kam oradaki bir makarayı hareket ettiremez"
    ),
    "{name} is no point of the ground: a cam turns about one": (
        "{name} sabit uzvun noktası değil: kam öyle bir noktada döner"
    ),
    "needs a motion over its angle": "açısına bağlı bir hareket gerekir",
    "write [[driver.segments]]": "[[driver.segments]] yazın",
    "goes with `segments`": "`segments` ile birlikte verilir",
    "rename it: the cam has a column of that name": "adını değiştirin: kamın bu adda bir sütunu var",
    "take masses and loads away, or let the roller or the face be on what [driver] names": (
        "kütleleri ve yükleri kaldırın ya da makarayı veya yüzü [driver] içinde adı geçen uzva koyun"
    ),
    "the cam presses on a link that its motion does not move directly: no forces yet": (
        "kam, hareketin doğrudan sürmediği bir uzva basıyor: kuvvetler henüz hesaplanamıyor"
    ),
    # what has a name
    "contact force": "temas kuvveti",
    "column of the cam": "kamın sütunu",
    "angle of the cam": "kamın açısı",
    "cam": "kam",
    "segment": "hareket parçası",
    # notes of keys
    "a point of the link on it": "uzvun yüz üzerindeki bir noktası",
    "how the way grows with the cam's angle": "yolun kam açısıyla nasıl arttığı",
    "its centre, a point of any moving link": "merkezi, hareketli bir uzvun noktası",
    "its radius; 0 for a knife edge": "yarıçapı; bıçak ağız için 0",
    "radius of the base circle": "temel dairenin yarıçapı",
    "the link that has it": "onu taşıyan uzuv",
    "the point of the ground about which the cam turns": "sabit uzvun, kamın çevresinde döndüğü noktası",
}
