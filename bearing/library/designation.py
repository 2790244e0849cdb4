"""Designations of ball bearings: series, bore, contact angle, and the suffixes that matter here.

A designation is read from left to right: a maker's name or prefix, the series, two digits for the
bore, the letters of the contact angle, then suffixes in any order. The letters differ between
makers; those of SKF, FAG (Schaeffler), NSK and NTN are known. Suffixes of cage, shield, grease and
marking have no effect and are ignored; a suffix that is not known makes the designation unknown.
"""

import re
from dataclasses import dataclass, replace
from functools import lru_cache

# series and its synonyms: dimension series of ISO 15, and whether of angular contact
SERIES = {
    "618": ("18", False),
    "619": ("19", False),
    "160": ("00", False),
    "60": ("10", False),
    "630": ("30", False),
    "62": ("02", False),
    "622": ("22", False),
    "63": ("03", False),
    "623": ("23", False),
    "64": ("04", False),
    "719": ("19", True),
    "70": ("10", True),
    "72": ("02", True),
    "73": ("03", True),
}
SMALL = "small"  # series of miniature and inch bearings, whose code is a name of its own
# miniature bearings, 608, 688, 618/8 or MR63, and inch ones, R168 or EE3
SMALL_CODE = (
    r"(?:60[4-9]|62[3-9]|63[45]|68[3-9]|69[3-9]|61[89] [3-9])(?!\d)|R\d+A?(?![\dA])"
    r"|MR(?:63|74|8[35]|95|10[56]|11[57]|12[68]|148)|EE[2-6](?!\d)"
)
SYNONYMS = {"68": "618", "69": "619", "79": "719"}  # NSK, NTN
ANGLES = {"C": 15.0, "AC": 25.0, "B": 40.0}  # nominal contact angle by suffix [deg]
SET_FOLLOWS = "(?=D[BFT](?!N))"  # 7014CDB is C and DB, not SKF's CD; TN is a cage
# makers' letters for them, as patterns, longer ones first; E is FAG's
ANGLE_LETTERS = (
    (rf"AC(?:{SET_FOLLOWS}|[DEB]?)|A5|E(?![A-Z])", "AC"),
    (r"BE?(?:[CG][ABC])?", "B"),
    (rf"C(?:{SET_FOLLOWS}|[DE]?)(?!\d)", "C"),
)
MAKERS = "SKF|FAG|INA|NSK|NTN|KOYO|NACHI|SNR|TIMKEN|BARDEN|GMN|NMB|URB|ZVL"
# B, HCB: FAG's spindle bearings; HC, XC: their ceramic balls; E2: SKF's of low friction;
# S of angular contact: SKF's with seals that do not rub
# S, SS, W of deep groove: rings and balls of stainless steel
PREFIXES = {
    "HYBRID": "hybrid", "FULL CERAMIC": "full ceramic", "CERAMIC": "full ceramic",
    "CE": "full ceramic", "SS": "stainless", "W": "stainless",
    "HCB": "hybrid", "XCB": "hybrid", "HC": "hybrid", "XC": "hybrid",
    "E2": "", "B": "", "S": "", "": "",
}  # fmt: skip
CLEARANCES = {"C2": "C2", "CN": "CN", "C0": "CN", "CM": "CM", "C3": "C3", "C4": "C4", "C5": "C5"}
TOLERANCES = {
    "P0": "normal", "PN": "normal", "P6": "P6", "P5": "P5",
    "P4A": "P4", "P4S": "P4", "P4": "P4", "PA9A": "P2", "P2": "P2",
}  # fmt: skip
CONTACT_SEALS = ("2RS1", "2RSR", "2RSH", "2RS", "2HRS", "DDU", "DDW", "DD", "LLU", "LLH", "EE")
# with seals that do not rub
SHIELDS = ("2RSL", "2RSD", "2BRS", "2RZ", "2ZR", "2Z", "ZZ", "VV", "LLB")
HYBRID = ("HYBRID", "HC5", "HC")
FULL_CERAMIC = ("FULLCERAMIC", "CERAMIC")
# sets of two, and how far they are preloaded
ARRANGEMENTS = ("DB", "DF", "DT")
PRELOADS = {
    "A": "light", "B": "medium", "C": "heavy", "L": "light", "M": "medium", "H": "heavy",
    "LIGHT": "light", "MEDIUM": "medium", "HEAVY": "heavy",
}  # fmt: skip
SETS = (
    "(?P<set>DB|DF|DT|DU|DG|SU|U|G) ?G?(?P<preload>LIGHT|MEDIUM|HEAVY|[ABCLMH])"
    "|(?P<alone>DB|DF|DT)"
)
WITHOUT_EFFECT = (
    # current insulation, grease, packing
    r"VL\d{4}|V[JT]?\d{3,4}|LHT\d+|HT\d*|LT\d*|MT\d+|GJN|WT|5K|2AS|NS7S?|NS|AV2S?|L\d{3}|S\d|"
    # FAG's present design: 7205-B-XL, 6205-C-2HRS
    r"XL|C(?!\w)|"
    # one seal or shield alone
    "HRS|BRS|RS1|RSR|RSH|RSL|RS|RZ|ZR|DU|LU|LB|Z|V|"
    # cages, snap rings
    "TN9|TNH|TVP2|TVP|TVH|TYN|TR|TN|TA|MPA|MPB|MA|MB|JR|PHAS|PH|BP|J|M|Y|T|P|F|NR|N|W|DG|U|G"
)
# reason why a designation is none of the bearings here, by its beginning
SINGLE_ROWS = "the catalogue has deep groove and angular contact ones"
BALLS_HERE = "the catalogue has ball bearings only"
NOT_HERE = (
    (r"QJ?\d", f"a four-point contact bearing; {SINGLE_ROWS}"),
    (r"(?:NU|NJ|NUP|NN|N|RN|RNU|NF|NH)\d", f"a cylindrical roller bearing; {BALLS_HERE}"),
    (r"(?:NA|NK|NKI|HK|BK|RNA|K)\d", f"a needle roller bearing; {BALLS_HERE}"),
    (r"(?:30|31|32|33)\d{3}", f"a tapered roller bearing; {BALLS_HERE}"),
    (r"(?:21|22|23|24)\d{3}", f"a spherical roller bearing; {BALLS_HERE}"),
    (r"5[1-4]\d{3}", "a thrust ball bearing; the catalogue has radial ones only"),
    (r"(?:12|13|22|23)\d\d(?!\d)", f"a self-aligning ball bearing; {SINGLE_ROWS}"),
    (
        r"(?:32|33|42|43|52|53)\d\d(?!\d)",
        "a double-row bearing; the catalogue has single rows, and pairs of them (DB, DF, DT)",
    ),
    (r"(?:HS|XCS|RS)\d", "a high-speed bearing with smaller balls than the catalogue's"),
    (r"161\d\d(?!\d)", "a bearing of the series 161, which the catalogue does not have"),
    (
        r"(?:70|72|73|719|79)\d\d",
        "the letters of its contact angle are missing or not known: C is 15 deg, AC 25, B 40",
    ),
    ("|".join(sorted({*SERIES, *SYNONYMS})), "its bore is not among those of the catalogue"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Designation:
    """Contents of a designation."""

    series: str  # of `SERIES`
    bore_number: int  # [-]
    angle_suffix: str = ""  # of `ANGLES`, empty of deep groove bearings
    clearance_class: str | None = None
    tolerance_class: str | None = None
    sealed: bool = False  # contact seals on both sides
    greased: bool = False  # seals or shields on both sides, filled with grease by the maker
    balls: str = ""  # "hybrid", "full ceramic", "stainless" or empty
    code: str = ""  # of a miniature or inch bearing, whose series is `SMALL`
    arrangement: str = ""  # of a set of two: DB, DF, DT, or empty
    preload_class: str | None = None  # light, medium, heavy

    @property
    def basic(self) -> str:
        """Name of the bearing in the catalogue: series, bore number, contact angle."""
        return self.code or f"{self.series}{self.bore_number:02d}{self.angle_suffix}"

    @property
    def bore(self) -> float:
        """Bore diameter [mm]: numbers 00 to 03 are 10, 12, 15, 17 mm, then five times the
        number.
        """
        number = self.bore_number
        return (10.0, 12.0, 15.0, 17.0)[number] if number < 4 else 5.0 * number

    @property
    def dimension_series(self) -> str:
        """Dimension series of ISO 15, width and diameter."""
        return SERIES[self.series][0]

    @property
    def angular(self) -> bool:
        """True for a bearing of angular contact."""
        return self.series != SMALL and SERIES[self.series][1]

    @property
    def contact_angle(self) -> float:
        """Nominal contact angle [deg], zero of deep groove bearings."""
        return ANGLES.get(self.angle_suffix, 0.0)


def read_designation(text: str) -> Designation | None:
    """Read a designation of one of the series here.

    Case, spaces, hyphens and slashes do not matter, but for the slash before a bore in
    millimetres, as in 618/10.

    Parameters
    ----------
    text : str
        designation with or without a maker's name

    Returns
    -------
    Designation | None
        its parts; None if it is of no series here or has suffixes that are not known

    Examples
    --------
    >>> from oilfilm.bearing.library.designation import read_designation
    >>> read = read_designation("SKF 6205-2RS C3")
    >>> read.basic, read.sealed, read.clearance_class
    ('6205', True, 'C3')
    """
    read, rest = _read(text)
    return None if rest else read


@lru_cache(maxsize=256)
def _read(text: str) -> tuple[Designation | None, str]:
    """Contents of a designation and its unknown end; None if it is none of the series here."""
    prefixes = "|".join(sorted(PREFIXES, key=len, reverse=True))
    series = "|".join(sorted({*SERIES, *SYNONYMS}, key=len, reverse=True))
    begin = rf"((?:(?:{MAKERS}) )?(?:{prefixes}) ?(?:{series}))"
    text = re.sub(rf"{begin} ?/ ?(\d+)(?!\d)", _bore_in_millimetres, text.upper().strip())
    plain = re.sub(r"[\s/_.,+-]+", " ", text).strip()
    pattern = rf"(?:(?:{MAKERS}) )?({prefixes}) ?({series})(\d\d)(.*)"
    match = re.fullmatch(pattern, plain)
    if match is None:
        return _small(plain, prefixes)
    prefix, series, bore, rest = match.groups()
    read = Designation(
        series=SYNONYMS.get(series, series),
        bore_number=int(bore),
        balls=PREFIXES[prefix],
        greased=prefix == "S" and SERIES[SYNONYMS.get(series, series)][1],
    )
    if read.angular:
        read, rest = _with_angle(read, rest)
        if not read.angle_suffix or read.balls == "stainless":
            return None, ""
    elif prefix == "B":
        return None, ""
    elif prefix == "S":
        read = replace(read, balls="stainless")
    return _with_suffixes(read, rest)


def _small(plain: str, prefixes: str) -> tuple[Designation | None, str]:
    """Likewise of a miniature or inch bearing."""
    match = re.fullmatch(rf"(?:(?:{MAKERS}) )?({prefixes}) ?({SMALL_CODE})(.*)", plain)
    if match is None or match[1] == "B":
        return None, ""
    balls = "stainless" if match[1] == "S" else PREFIXES[match[1]]
    code = match[2].replace(" ", "/")
    read = Designation(series=SMALL, bore_number=0, code=code, balls=balls)
    return _with_suffixes(read, match[3])


def _bore_in_millimetres(match: re.Match[str]) -> str:
    """Beginning of a designation with its bore number in place of a slash and the bore [mm]."""
    bore = int(match[2])
    number = {10: 0, 12: 1, 15: 2, 17: 3}.get(bore)
    if number is None and bore >= 20 and bore % 5 == 0:
        number = bore // 5
    return match[0] if number is None else f"{match[1]}{number:02d}"


def _with_angle(read: Designation, rest: str) -> tuple[Designation, str]:
    rest = rest.strip()
    for letters, suffix in ANGLE_LETTERS:
        match = re.match(letters, rest)
        if match is not None:
            return replace(read, angle_suffix=suffix), rest[match.end() :]
    return read, rest


def _with_suffixes(read: Designation, rest: str) -> tuple[Designation, str]:
    """The designation with its suffixes read, up to the first one that is not known, and this."""
    words: dict[str, dict[str, object]] = {
        **{word: {"tolerance_class": name} for word, name in TOLERANCES.items()},
        **{word: {"clearance_class": name} for word, name in CLEARANCES.items()},
        **{key: {"sealed": True, "greased": True} for key in CONTACT_SEALS},
        **{key: {"greased": True} for key in SHIELDS},
        **{key: {"balls": "hybrid"} for key in HYBRID},
        **{key: {"balls": "full ceramic"} for key in FULL_CERAMIC},
    }
    rest = rest.replace("FULL CERAMIC", "CERAMIC").strip()
    while rest:
        word = next((word for word in sorted(words, key=len)[::-1] if rest.startswith(word)), "")
        fields = words.get(word, {})
        if not word and read.angular and (match := re.match(SETS, rest)):
            word = match.group()
            fields = _set(match)
        if not word:
            match = re.match(WITHOUT_EFFECT, rest)
            if match is None:
                break
            word = match.group()
        read = replace(read, **fields)  # type: ignore[arg-type]
        rest = rest.removeprefix(word).strip()
    return read, rest


def _set(match: re.Match[str]) -> dict[str, object]:
    """Arrangement and preload class of a set of angular contact bearings."""
    arrangement = match["set"] or match["alone"] or ""
    fields: dict[str, object] = {}
    if arrangement in ARRANGEMENTS:
        fields["arrangement"] = arrangement
    if match["preload"] and arrangement:
        fields["preload_class"] = PRELOADS[match["preload"]]
    return fields


def why_unknown(text: str) -> str:
    """Explain why a designation is not known.

    Parameters
    ----------
    text : str
        name that is no designation of the catalogue

    Returns
    -------
    str
        reason, for a message; empty if none can be given
    """
    oil = re.search(r"\b(?:ISO ?)?VG ?\d+", text.upper())
    if oil is not None:
        return f"{oil.group()} is an oil, which goes to [lubricant] name"
    plain = _without_maker(text)
    rest = _read(text)[1]
    seems = next((why for pattern, why in NOT_HERE if re.match(pattern, plain)), "")
    if rest and not re.match(r"\d", rest):
        return f"'{rest.split()[0]}' in it is not known"
    return seems


def series_and_bore(text: str) -> Designation | None:
    """Series and bore with which a designation begins, whatever follows.

    Parameters
    ----------
    text : str
        designation with or without a maker's name

    Returns
    -------
    Designation | None
        series and bore number; None without them
    """
    series = "|".join(sorted({*SERIES, *SYNONYMS}, key=len, reverse=True))
    match = re.match(rf"(?:HCB?|XCB?|B)?({series})(\d\d)(?!\d)", _without_maker(text))
    if match is None:
        return None
    return Designation(series=SYNONYMS.get(match[1], match[1]), bore_number=int(match[2]))


def _without_maker(text: str) -> str:
    return re.sub(rf"^(?:(?:{MAKERS}) ?)", "", " ".join(text.upper().split()))
