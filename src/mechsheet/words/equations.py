"""What quantities, links and groups are called, in both languages."""

from __future__ import annotations

from collections.abc import Iterable

from mechsheet.model import Link, Mechanism, Words

NOTHING = Words("", "")

TERMS = {
    "arm": "kol",
    "block": "kızak",
    "coupler": "biyel",
    "crank": "krank",
    "frame": "gövde",
    "ground": "sabit uzuv",
    "input": "giriş uzvu",
    "lever": "kol",
    "output": "çıkış uzvu",
    "piston": "piston",
    "plunger": "piston",
    "ram": "koç",
    "rocker": "sarkaç",
    "rod": "biyel",
    "slider": "kızak",
}
"""English name of a link -> the Turkish one."""

BLOCK = "block of "
"""How the massless block of a pin-slot joint is called, before the joint's symbol."""

PHRASES = {
    # groups
    "and": ("{first} and {second}", "{first} ve {second}"),
    "group_pins": ("{links}: pins {pins}", "{links}: {pins} mafsalları"),
    "group_slide": ("{links}: pins {pins}, slide {slide}", "{links}: {pins} mafsalları, {slide} kayması"),
    "group_two_slides": ("{links}: pin {pin}, slides {slides}", "{links}: {pin} mafsalı, {slides} kaymaları"),
    "left_of": ("{point} left of {start}→{end}", "{point}, {start}→{end} solunda"),
    "right_of": ("{point} right of {start}→{end}", "{point}, {start}→{end} sağında"),
    "larger_of_two": ("{symbol} the larger of two", "{symbol} ikisinden büyüğü"),
    "smaller_of_two": ("{symbol} the smaller of two", "{symbol} ikisinden küçüğü"),
    "tooth_tangent": (
        "tooth force of {one} on {other}, along the pitch line", "{one} → {other} diş kuvveti, yuvarlanma doğrusu boyunca"
    ),
    "tooth_part": ("tooth force of {one} on {other}, {axis} part", "{one} → {other} diş kuvveti, {axis} bileşeni"),
    "tooth_force": ("tooth force of {one} on {other}", "{one} → {other} diş kuvveti"),
    "belt_torque": ("torque of {one} on {other}", "{one} → {other} momenti"),
    "pitch_point": ("pitch point of {one} and {other}, {axis}", "{one} ile {other} yuvarlanma noktası, {axis}"),
    "further_driver": ("driven besides", "ayrıca tahrik edilen"),
    "follower": ("moved by the cam", "kamın hareket ettirdiği"),
    "within_turn": ("angle of the cam within its turn", "turu içinde kam açısı"),
    "segment_number": ("number of the segment", "hareket parçasının numarası"),
    "segment_begins": ("where the segment begins", "parçanın başladığı açı"),
    "segment_over": ("over which angle the segment goes", "parçanın sürdüğü açı"),
    "segment_lift": ("lift where the segment begins", "parçanın başındaki kalkma"),
    "segment_by": ("how far the segment goes", "parçanın yolu"),
    "segment_law_0": ("law of the segment", "parçanın yasası"),
    "segment_law_1": ("first derivative of the law", "yasanın birinci türevi"),
    "segment_law_2": ("second derivative of the law", "yasanın ikinci türevi"),
    "segment_law_3": ("third derivative of the law", "yasanın üçüncü türevi"),
    "segment_half": ("1 in the second half of the segment", "parçanın ikinci yarısında 1"),
    "segment_piece": ("number of the law's piece", "yasanın dilim numarası"),
    "segment_wave": ("4π times the part passed, from the nearer end", "yakın uçtan geçilen bölümün 4π katı"),
    "segment_passed": ("part of the segment that has been passed", "hareket parçasının geçilen bölümü"),
    "by_cam_1": ("first derivative of {symbol} by the cam's angle", "{symbol}: kam açısına göre birinci türev"),
    "by_cam_2": ("second derivative of {symbol} by the cam's angle", "{symbol}: kam açısına göre ikinci türev"),
    "by_cam_3": ("third derivative of {symbol} by the cam's angle", "{symbol}: kam açısına göre üçüncü türev"),
    "jerk": ("jerk of {symbol}: third derivative by time", "{symbol} için sarsım: zamana göre üçüncü türev"),
    "cam_T": ("tangent of the pitch curve, {axis}", "adım eğrisinin teğeti, {axis}"),
    "cam_cam": ("point of the profile seen from the cam's centre, {axis}", "kam merkezinden profil noktası, {axis}"),
    "cam_p": ("distance of the face from the cam's centre, or its derivative", "yüzün kam merkezine uzaklığı ya da türevi"),
    "cam_is_pitch": ("pitch curve in the axes of the cam, {axis}", "kam eksenlerinde adım eğrisi, {axis}"),
    "cam_is_cam": ("profile in the axes of the cam, {axis}", "kam eksenlerinde profil, {axis}"),
    "cam_is_kappa": ("curvature of the pitch curve", "adım eğrisinin eğriliği"),
    "cam_is_rho": ("radius of curvature of the profile", "profilin eğrilik yarıçapı"),
    "cam_is_alpha": ("pressure angle", "basınç açısı"),
    "cam_is_contact": ("where the face touches, along it", "yüzün değdiği yer, yüz boyunca"),
    "averaged": ("{symbol}, of which a mean is taken", "{symbol}: ortalaması alınan"),
    # lengths and places
    "tolerance": ("lengths below this count as zero", "bundan kısa uzunluklar sıfır sayılır"),
    "fixed_point": ("{point}, fixed, {axis}", "{point}, sabit, {axis}"),
    "coordinate": ("{point}, {axis} coordinate", "{point} noktası, {axis} koordinatı"),
    "point_on": ("{point} on {link}", "{link}: {point}"),
    "place_in_link": ("{point} in the frame of {link}", "{link} takımında {point}"),
    "way_in_link": ("from the pin to {point}, in the frame of {link}", "{link} takımında mafsaldan {point} yerine"),
    "turned_in_pair": ("angle of {link} in the frame of the driven pair", "{link} açısı, tahrik çiftinin takımında"),
    "in_driven_pair": ("{name} in the frame of the driven pair", "{name}, tahrik çiftinin takımında"),
    "origin": ("origin of {link}", "{link}: başlangıç noktası"),
    "length_in_link": ("{start}–{end} on {link}", "{link}: {start}–{end}"),
    "distance": ("distance {start}–{end}", "{start}–{end} uzaklığı"),
    "part_of_way": ("{start}→{end}, {axis} part", "{start}→{end}, {axis} bileşeni"),
    "part_of": ("{what}, {axis} part", "{what}, {axis} bileşeni"),
    "displacement": ("displacement of {point} on {link}", "{point} noktasının ötelenmesi ({link} üzerinde)"),
    "to_guide": ("{point} to the guide, {axis} part", "{point}'den kızağa, {axis} bileşeni"),
    "along_guide": ("{point} to the guide's origin, along it", "{point}'den kızak başlangıcına, kızak boyunca"),
    "across_guide": ("{point} to the guide, across it", "{point}'den kızağa dik uzaklık"),
    "arm_along_guide": ("{start}–{end} along the guide", "kızak boyunca {start}–{end}"),
    "way_along": ("{start}→{end} along {symbol}", "{symbol} boyunca {start}→{end}"),
    "slot_offset": ("slot offset", "kanal kaçıklığı"),
    "between_lines": ("from line 1 to line 2, {axis} part", "1. doğrudan 2. doğruya, {axis} bileşeni"),
    # angles
    "angle": ("angle {name}", "{name} açısı"),
    "angle_of": ("angle of the {link}", "{link} açısı"),
    "angle_of_link": ("angle of link {number}, {link}", "{number} numaralı uzvun açısı ({link})"),
    "angle_in_link": ("angle {name} of {link}", "{link}: {name} açısı"),
    "angle_between": ("angle between {start}→{end} and {symbol}", "{start}→{end} ile {symbol} arasındaki açı"),
    "angle_to_guide": ("angle of {start}–{end} to the guide", "{start}–{end} ile kızak arasındaki açı"),
    "transmission_angle": ("angle {name} (transmission)", "{name} açısı (bağlama)"),
    "direction_of": ("direction of {what}", "{what} doğrultusu"),
    "direction_in_link": ("direction of {point} on {link}", "{link}: {point} doğrultusu"),
    "direction_of_guide": ("direction of the guide of {symbol}", "{symbol} kızağının doğrultusu"),
    "sine_between_lines": ("sine of the angle between the lines", "doğrular arasındaki açının sinüsü"),
    "sine_where_they_meet": ("the same; #N/A where the lines are parallel", "aynısı; doğrular paralelse #N/A"),
    # velocities and accelerations
    "velocity_word": ("velocity", "hız"),
    "acceleration_word": ("acceleration", "ivme"),
    "determinant": ("0 at a dead centre; #N/A there", "ölü konumda 0; orada #N/A"),
    "coefficient": ("influence coefficient of {symbol} ({order})", "{symbol} etki katsayısı ({order})"),
    "known_side": (
        "known side of the {order} equations, {axis} part", "{order} denklemlerinin bilinen yanı, {axis} bileşeni"
    ),
    "known_side_of": (
        "known side of the {order} equation {number}", "{number}. {order} denkleminin bilinen yanı"
    ),
    "gap_part": (
        "gap of the two ways round link {number}, {order}, {axis} part",
        "{number}. bağlantıdaki iki yol arasındaki fark, {order}, {axis} bileşeni",
    ),
    "driver_speed": ("speed of the driver", "tahrik hızı"),
    "driver_acceleration": ("acceleration of the driver", "tahrik ivmesi"),
    "angular_velocity": ("angular velocity of link {number}, {link}", "{number} numaralı uzvun açısal hızı ({link})"),
    "angular_acceleration": (
        "angular acceleration of link {number}, {link}", "{number} numaralı uzvun açısal ivmesi ({link})"
    ),
    "sliding_velocity": ("sliding velocity of {symbol}", "{symbol} kayma hızı"),
    "sliding_acceleration": ("sliding acceleration of {symbol}, along the line", "{symbol} kayma ivmesi, doğru boyunca"),
    "point_v": ("velocity of {point}", "{point} noktasının hızı"),
    "point_a": ("acceleration of {point}", "{point} noktasının ivmesi"),
    "point_v_part": ("velocity of {point}, {axis} part", "{point} noktasının hızı, {axis} bileşeni"),
    "point_a_part": ("acceleration of {point}, {axis} part", "{point} noktasının ivmesi, {axis} bileşeni"),
    # forces
    "across_link": ("what {link} exerts across its pins", "{link} uzvunun mafsallarına dik uyguladığı"),
    "held_by": ("with what equation {number} of the group holds", "grubun {number}. denkleminin tuttuğu"),
    "metre": ("metres in one {unit}", "bir {unit} kaç metre"),
    "velocity_part": ("velocity of the {what}, {axis} part", "{what} hızı, {axis} bileşeni"),
    "velocity_of": ("velocity of the {what}", "{what} hızı"),
    "acceleration_of": ("acceleration of the {what}", "{what} ivmesi"),
    "flywheel_energy": (
        "energy that a flywheel has given since the first row", "volanın ilk satırdan beri verdiği enerji"
    ),
    "power": ("power that the driver gives", "tahrik gücü"),
    "shaking_force": ("shaking force on the ground, {axis} part", "gövdeye sarsma kuvveti, {axis} bileşeni"),
    "shaking_moment": ("shaking moment about the origin", "orijine göre sarsma momenti"),
    "mass_centre": ("mass centre of {link}", "kütle merkezi ({link})"),
    "loaded_place": ("where {name} acts", "{name} yükünün yeri"),
    "load": ("load {name}", "{name} yükü"),
    "load_part": ("load {name}, {axis} part", "{name} yükü, {axis} bileşeni"),
    "spring_length": ("length of the spring {name}, {start}–{end}", "{name} yayının boyu, {start}–{end}"),
    "spring_velocity": ("ends of {name}, relative velocity, {axis} part", "{name} uçlarının bağıl hızı, {axis} bileşeni"),
    "spring_force": ("force of the spring {name}, positive where it pulls", "{name} yayının kuvveti, artıysa çeker"),
    "spring_hold": (
        "free length of {name} with which cam and follower would just touch",
        "{name} yayının, kam ile izleyicinin ancak değeceği serbest boyu",
    ),
    "sum_of_forces": (
        "weight, inertia and loads of {link}: force, {axis} part", "{link}: ağırlık, atalet ve yükler, {axis} bileşeni"
    ),
    "sum_along": (
        "weight, inertia and loads of {link}: force along the guide", "{link}: ağırlık, atalet ve yükler, kızak boyunca"
    ),
    "sum_of_moments": (
        "weight, inertia and loads of {link}: moment", "{link}: ağırlık, atalet ve yüklerin momenti"
    ),
    "joint_force": ("force of {one} on {other} at {point}", "{point} mafsalında {one} → {other} kuvveti"),
    "force_on": ("force on {link} at {point}, {axis} part", "{point} noktasında {link} üzerindeki kuvvet, {axis} bileşeni"),
    "normal_force": ("normal force of {one} on {other}", "{one} → {other} normal kuvveti"),
    "slide_force": ("force of {one} on {other}, {axis} part", "{one} → {other} kuvveti, {axis} bileşeni"),
    "couple": ("couple of {one} on {other} about {point}", "{point} noktasına göre {one} → {other} kuvvet çifti"),
    "contact_force": (
        "force of {one} on {other}, along the profile's normal", "{one} → {other} kuvveti, profil normali boyunca"
    ),
    "driving_torque": ("driving torque of {one} on {other}", "tahrik momenti, {one} → {other}"),
    "driving_force": ("driving force of {one} on {other}", "tahrik kuvveti, {one} → {other}"),
    "by_work": ("the same by virtual work", "aynısı, virtüel iş ile"),
    # tolerances
    "constant_derivative": ("change of {symbol} by {dimension}", "{dimension} değişince {symbol} değişimi"),
    "gap_influence": (
        "how far a gap of 1 in the loop would move {symbol}", "devrede 1 birimlik açıklık {symbol} değerini ne kadar oynatır"
    ),
    "sensitivity": (
        "change of {symbol} by one unit of {dimension}, the driver standing",
        "{dimension} bir birim büyürse {symbol} ne kadar değişir, tahrik dururken",
    ),
    "band": ("band of {symbol}", "{symbol} sapma bandı"),
    "band_worst": (
        "{symbol}: all tolerances at their worst ends", "{symbol}: bütün toleranslar en kötü uçlarında"
    ),
    "band_root": (
        "{symbol}: root of the sum of squares; tolerances independent",
        "{symbol}: karelerin toplamının karekökü; toleranslar bağımsız",
    ),
    "band_low": ("{symbol} less the worst case", "{symbol} eksi en kötü durum"),
    "band_high": ("{symbol} plus the worst case", "{symbol} artı en kötü durum"),
    # groups solved by Newton's method
    "largest_length": ("the largest length given", "verilen en büyük uzunluk"),
    "newton_distance": (
        "F: {start}–{end} against the length of {link}", "F: {start}–{end}, {link} boyu ile karşılaştırılır"
    ),
    "newton_offset": (
        "F: distance of {point} from the line of {symbol}", "F: {point} noktasının {symbol} doğrusuna uzaklığı",
    ),
    "newton_pin": ("F: gap at the pin {point}, {axis} part", "F: {point} mafsalındaki açıklık, {axis} bileşeni"),
    "newton_tie": ("F: what {links} miss of their ratio", "F: {links} oranının açığı"),
    "newton_slope": ("J: derivative of F{row} by {symbol}", "J: F{row} türevi, {symbol} ile"),
    "newton_minor": ("a minor, for Cramer's rule", "bir minör, Cramer kuralı için"),
    "newton_det": ("determinant of J: 0 where two assemblies meet", "J determinantı: iki montaj birleşince 0"),
    "newton_residual": ("residual: largest |F|, in parts of the size", "kalan: en büyük |F|, büyüklüğe oranla"),
    "newton_fits": ("whether it has arrived, in the same assembly", "aynı montajda varıldı mı"),
    # what cells and programs need besides
    "area": ("area of triangle {name}", "{name} üçgeninin alanı"),
    "area_for": ("area of the triangle of {symbol}", "{symbol} üçgeninin alanı"),
    "within_half_a_turn": ("{angle}, within half a turn", "{angle}"),
    "margin": ("how far from coming apart (not joined below 0)", "ayrılmaya uzaklık (0'ın altında birleşmez)"),
    "block": ("block of {symbol}", "{symbol} bloğu"),
}  # fmt: skip
"""Key -> English and Turkish, with the names of its parts."""


def phrase(key: str, **parts: str | Words) -> Words:
    """The phrase with its parts in place, each in its own language where it has words of its own."""
    en, tr = PHRASES[key]
    spelt = {name: part if isinstance(part, Words) else same(part) for name, part in parts.items()}
    return Words(
        en.format(**{name: part.en for name, part in spelt.items()}),
        tr.format(**{name: part.tr for name, part in spelt.items()}),
    )


def same(text: str) -> Words:
    """A text that is the same in both languages: a symbol, a name."""
    return Words(text, text)


def listed(words: Iterable[Words]) -> Words:
    """Names beside each other."""
    found = tuple(words)
    return Words(" + ".join(each.en for each in found), " + ".join(each.tr for each in found))


def several(words: Iterable[Words]) -> Words:
    """Names one after another."""
    found = tuple(words)
    return Words(", ".join(each.en for each in found), ", ".join(each.tr for each in found))


def link_words(link: Link) -> Words:
    """A link: the label of the description, or the field's own word for a common name; another name stays as it is."""
    return link.label or Words(link.name, TERMS.get(link.name, link.name))


def body_words(mechanism: Mechanism, name: str) -> Words:
    """A link, or the block of a pin-slot joint, by its name."""
    if name.startswith(BLOCK):
        return phrase("block", symbol=name.removeprefix(BLOCK))
    return next((link_words(link) for link in mechanism.links if link.name == name), same(name))
