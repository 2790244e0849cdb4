"""Write docs/validation/validation_004.md: sliding friction of the 6206 by pure rolling lines.

Run it with `python tools/docs/validation_004.py`.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import pi
from pathlib import Path

from printed import printed

from oilfilm.bearing import BallKinematics, contact_conditions, solve_quasistatic, solve_traction_equilibrium
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.friction.coulomb import balanced_friction
from oilfilm.bearing.friction.friction_sources import CoulombTraction
from oilfilm.bearing.torque.breakdown import friction_torque
from oilfilm.bearing.torque.paper_models import sliding_contacts
from oilfilm.cases import Case, load_case

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_004.md"
TEMPLATE = PAGE.with_suffix(".md.in")
RPM = pi / 30.0  # [rad/s]
LOADS = {"6206_axial_500N": (500.0, 0.0), "6206_radial_500N": (0.0, 500.0), "6206_combined_1000N": (1000.0, 1000.0)}
CASES = {stem: load_case(stem) for stem in LOADS}
COMBINED = "6206_combined_1000N"
SPEEDS = (500.0, 5000.0, 15000.0)
STATIC_RATINGS = {"6206": 11.2, "6207": 15.3, "6208": 19.0}  # C_0, assumed [kN]
FIGURE_15_SPEEDS = (500.0, 1000.0, 5000.0, 10000.0, 15000.0)
CLOSER_GROOVES = {"inner_groove_radius": 0.51 * 9.525e-3, "outer_groove_radius": 0.52 * 9.525e-3}  # of the 6206 [m]
SIZES = {row["bearing"]: row for row in printed("sliding_friction_6206_table_1")}


def solved(case: Case, speed: float, loads: tuple[float, float], **changes: object):
    """Breakdown [N m], solution and contacts at a speed [r/min], axial and radial load [N]."""
    operation = replace(case.operation, inner_speed=speed * RPM, force=(*loads, 0.0))
    if changes.get("free"):
        operation = replace(operation, moment=(0.0, 0.0), tilt=(None, None))
    bearing = replace(case.bearing, **changes.get("grooves", {}))  # type: ignore[arg-type]
    kinematics = changes.get("kinematics", case.model.ball_kinematics)
    model = replace(case.model, ball_kinematics=kinematics)  # type: ignore[arg-type]
    solve = solve_quasistatic
    if "traction" in changes:
        solve = partial(solve_traction_equilibrium, traction=changes["traction"])  # type: ignore[arg-type]
    state = solve(bearing, operation, model)
    assert state.converged
    contacts = contact_conditions(state, case.lubricant)
    assert case.friction is not None  # of every bearing case
    return friction_torque(state, contacts, case.lubricant, case.friction), state, contacts


def table(stem: str, column: str) -> list[float]:
    """Torque over `SPEEDS` at the loads of a case as Tables 2 to 4 print it [N mm]."""
    rows = printed("sliding_friction_6206_tables_2_to_4")
    at_loads = [r for r in rows if (float(r["axial_load_N"]), float(r["radial_load_N"])) == LOADS[stem]]
    of_speed = {float(row["inner_speed_rpm"]): float(row[column]) for row in at_loads}
    return [of_speed[speed] for speed in SPEEDS]


def total(result, name: str) -> float:
    """Torque of a model [N mm]."""
    value = result.models[name].total
    assert value is not None
    return 1e3 * value


def sliding(result, name: str) -> float:
    """Sliding component of a model [N mm]."""
    return 1e3 * result.models[name].components["sliding"]


def named(stem: str) -> str:
    """Load of a case in words."""
    axial, radial = LOADS[stem]
    parts = [f"{load:.0f} N {word}" for load, word in ((axial, "axial"), (radial, "radial")) if load]
    return ", ".join(parts)


def tables() -> tuple[str, str, dict[str, float]]:
    """Lines of the first two tables, and lines over printed at 500 r/min by case."""
    skf, lines, ratios = [], [], {}
    for stem, free in (*((stem, False) for stem in LOADS), (COMBINED, True)):
        columns = table(stem, "proposed_torque_N_mm"), table(stem, "skf_torque_N_mm")
        for speed, proposed, of_skf in zip(SPEEDS, *columns, strict=True):
            result, _, _ = solved(CASES[stem], speed, LOADS[stem], free=free)
            true = sliding(result, "skf")
            head = f"| {named(stem)}{', free to tilt' if free else ''} | {speed:.0f} |"
            if not free:  # SKF's model knows no tilt
                skf.append(f"{head} {of_skf:.4f} | {sliding(result, 'skf_as_printed'):.4f} | {true:.4f} |")
            ours = total(result, "pure_rolling_lines")
            others = f"{total(result, 'balanced_lines'):.2f} | {total(result, 'coulomb'):.2f}"
            lines.append(f"{head} {proposed} | {ours:.2f} | {others} | {ours / proposed:.3f} | {ours / true:.3f} |")
            if speed == SPEEDS[0]:
                name = f"{stem} free" if free else stem
                ratios[name], ratios[f"{name} true"] = ours / proposed, ours / true
    return "\n".join(skf), "\n".join(lines), ratios


def choices() -> str:
    """Lines of the table of ball kinematics and tilt."""
    ways: list[tuple[str, dict[str, object]]] = [
        (f"{k.value}, kept straight", {"kinematics": k})
        for k in (BallKinematics.OUTER_RACE_CONTROL, BallKinematics.INNER_RACE_CONTROL, BallKinematics.HALF_AND_HALF)
    ]
    coulomb = CoulombTraction(friction=solved(CASES["6206_axial_500N"], 500.0, (500.0, 0.0))[0].coefficient)
    traction = BallTraction(source=coulomb, lubricant=CASES["6206_axial_500N"].lubricant)
    equilibrium = {"kinematics": BallKinematics.TRACTION_EQUILIBRIUM, "traction": traction}
    ways += [("traction equilibrium (Coulomb, µ_sl), kept straight", equilibrium)]
    control = {"kinematics": BallKinematics.OUTER_RACE_CONTROL, "free": True}
    ways += [
        ("outer race control, free to tilt", control),
        ("half and half, free to tilt", {"free": True}),
        ("traction equilibrium, free to tilt", equilibrium | {"free": True}),
        ("half and half, free to tilt, grooves of 0.51 and 0.52", {"free": True, "grooves": CLOSER_GROOVES}),
        ("outer race control, free to tilt, grooves of 0.51 and 0.52", control | {"grooves": CLOSER_GROOVES}),
    ]
    rows = []
    for words, way in ways:
        cells, true = [], 0.0
        for stem, loads in LOADS.items():
            result, _, _ = solved(CASES[stem], 500.0, loads, **way)
            ours, reference = total(result, "pure_rolling_lines"), table(stem, "proposed_torque_N_mm")[0]
            true = sliding(result, "skf")
            if loads[0] == 0.0:
                reference = true
            cells.append(f"{ours:.2f} ({100.0 * (ours / reference - 1.0):+.1f} %)")
        cells.append(f"{100.0 * (ours / true - 1.0):+.1f} %")  # the last load is the combined one
        rows.append(f"| {words} | {' | '.join(cells)} |")
    return "\n".join(rows)


def figure_15() -> str:
    """Lines of the table of the components under combined load."""
    rows = []
    for words, change in (("held at zero", {}), ("free", {"free": True})):
        for speed in FIGURE_15_SPEEDS:
            result, state, _ = solved(CASES[COMBINED], speed, LOADS[COMBINED], **change)
            of = parts(result, "balanced_lines")
            cells = [f"{of[name]:.2f}" for name in ("spin", "rotation", "orbit")]
            tilt = 1e3 * max(abs(angle) for angle in state.tilt)  # [mrad]
            shares = f"{100.0 * of['spin'] / sum(of.values()):.0f} %"
            head = (
                f"| {words} | {speed:.0f} | {tilt:.2f} | {state.inner_load.min():.0f} to {state.inner_load.max():.0f}"
            )
            rows.append(f"{head} | {' | '.join(cells)} | {shares} | {sum(of.values()):.2f} |")
    return "\n".join(rows)


def line_errors() -> str:
    """Lines of the table of the line model's error."""
    rows, case = [], CASES["6206_axial_500N"]
    for loads in ((100.0, 0.0), (500.0, 0.0), (2000.0, 0.0), (1000.0, 1000.0), (0.0, 500.0), (0.0, 2000.0)):
        _, state, contacts = solved(case, 500.0, loads)
        speed = state.operation.shaft_speed
        pair = [1e3 * balanced_friction(state, contacts, 0.1, lines=flag).power.sum() / speed for flag in (True, False)]
        inner = next(c for c in sliding_contacts(state, contacts) if c.inner)
        ratio = inner.semi_axis / inner.semi_axis_rolling
        error = f"{100.0 * (pair[0] / pair[1] - 1.0):+.1f} %"
        rows.append(f"| {loads[0]:.0f} | {loads[1]:.0f} | {ratio:.1f} | {pair[0]:.2f} | {pair[1]:.2f} | {error} |")
    return "\n".join(rows)


def parts(result, name: str) -> dict[str, float]:
    """Components of a model [N mm]."""
    return {part: 1e3 * value for part, value in result.models[name].components.items()}


def figures_6_to_9() -> list[tuple[str, str, str]]:
    """Comparison of methods under 500 N axial."""
    case = CASES["6206_axial_500N"]
    result, _, _ = solved(case, 500.0, (500.0, 0.0))
    fast, _, _ = solved(case, 15000.0, (500.0, 0.0))
    lines, kakuta = parts(result, "balanced_lines"), parts(result, "kakuta")
    houpert = parts(result, "houpert")
    curved, conventional = lines["rotation"] + lines["orbit"], kakuta["rotation"] + kakuta["orbit"]
    constant = [total(x, "constant_coulomb") for x in (result, fast)]
    with_mu = [total(x, "balanced_lines") for x in (result, fast)]
    return [
        (
            "Fig. 6: Houpert's differential sliding torque above that of the updated c-values",
            "yes, by little" if houpert["curvature"] > curved else "no",
            f"500 r/min: {houpert['curvature']:.2f} and {curved:.2f} N mm",
        ),
        ("Fig. 6: Kakuta's below", "no", f"{conventional:.2f} N mm"),
        (
            "Fig. 7: spin of the lines agrees with Houpert's",
            "yes",
            f"{lines['spin']:.2f} and {houpert['spin']:.2f} N mm",
        ),
        ("Fig. 7: spin on one race only is lower", "no", f"{kakuta['spin']:.2f} N mm"),
        (
            "Fig. 8: constant µ = 0.07 departs from µ_sl",
            "yes",
            f"{constant[0]:.1f} and {constant[1]:.1f} N mm at 500 and 15000 r/min; "
            f"with µ_sl {with_mu[0]:.1f} and {with_mu[1]:.1f}",
        ),
        (
            "Fig. 9: spin and differential sliding by orbit dominate, that by ball rotation is small",
            "depends on the definition",
            f"spin {lines['spin']:.2f}, rotation {lines['rotation']:.2f}, orbit "
            f"{lines['orbit']:.2f} N mm "
            f"(split: see below)",
        ),
    ]


def figures_10_to_16() -> list[tuple[str, str, str]]:
    """Loads, sizes and speeds."""
    axial, radial = CASES["6206_axial_500N"], CASES["6206_radial_500N"]
    loads = (500.0, 1000.0, 1500.0)
    by_axial = [total(solved(axial, 5000.0, (f, 0.0))[0], "balanced_lines") for f in loads]
    by_radial = [total(solved(radial, 5000.0, (0.0, f))[0], "balanced_lines") for f in loads]
    both = [total(solved(axial, 5000.0, (f, 1000.0))[0], "balanced_lines") for f in loads]
    slow = [solved(radial, 10.0, (0.0, f))[0] for f in (500.0, 1000.0)]
    exact = total(slow[1], "pure_rolling_lines") / total(slow[0], "pure_rolling_lines")
    # the same friction at both speeds, so that what is left is the centrifugal force
    constant = [total(solved(axial, n, (500.0, 0.0))[0], "constant_coulomb") for n in (500.0, 15000.0)]
    sizes = {word: [sized(name, load) for name in SIZES] for word, load in (("a", (500.0, 0.0)), ("r", (0.0, 500.0)))}
    spin = parts(solved(radial, 5000.0, (0.0, 500.0))[0], "balanced_lines")["spin"]
    held, free = (solved(CASES[COMBINED], 5000.0, LOADS[COMBINED], free=flag)[0] for flag in (False, True))
    spins = [parts(result, "balanced_lines")["spin"] for result in (held, free)]
    return [
        ("Fig. 10: more axial load, more torque", "yes", f"500, 1000, 1500 N at 5000 r/min: {_three(by_axial)} N mm"),
        (
            "Fig. 10: the centrifugal force changes nothing even at high speed",
            "nearly",
            f"at constant µ, 500 N: {100.0 * (constant[1] / constant[0] - 1.0):+.1f} % from 500 to 15000 r/min",
        ),
        ("Fig. 11: under 500 N axial the torque grows with the size", "yes", f"6206, 6207, 6208: {_three(sizes['a'])}"),
        ("Fig. 12: no spin under radial load", "yes", f"{abs(spin):.4f} N mm"),
        (
            "Fig. 13: the torque grows more than in proportion to the radial load",
            "yes",
            f"500, 1000, 1500 N: {_three(by_radial)}; at 10 r/min double the load has {exact:.4f} = 2^(5/3) of it",
        ),
        ("Fig. 14: under 500 N radial the torque falls with the size", "yes", f"{_three(sizes['r'])} N mm"),
        (
            "Fig. 15: with axial load beside the radial one there is spin",
            "yes",
            f"5000 r/min: {spins[0]:.2f} N mm with the tilt held, {spins[1]:.2f} free",
        ),
        (
            "Fig. 16: radial load hardly changes the torque beside axial load",
            "not at light axial load",
            f"with 1000 N radial {_three(both)} instead of {_three(by_axial)} N mm",
        ),
        (
            "Conclusion: axial load contributes more than radial load",
            "yes",
            f"500 N: {by_axial[0]:.2f} against {by_radial[0]:.2f} N mm",
        ),
        (
            "Conclusion: the method agrees with SKF's model under all loads",
            "only with its halved radial values",
            "first two tables",
        ),
    ]


def _three(values: list[float]) -> str:
    return ", ".join(f"{value:.2f}" for value in values)


def sized(name: str, loads: tuple[float, float]) -> float:
    """Balanced lines of a bearing of Table 1 at 5000 r/min [N mm]."""
    case = resized(CASES["6206_axial_500N"], name)
    return total(solved(case, 5000.0, loads)[0], "balanced_lines")


def resized(case: Case, name: str) -> Case:
    """A case of the 6206 with dimensions and static rating of another bearing of Table 1."""
    size = {key: 1e-3 * float(value) for key, value in SIZES[name].items() if key.endswith("_mm")}
    bearing = replace(
        case.bearing,
        ball_diameter=size["ball_diameter_mm"],
        pitch_diameter=size["pitch_diameter_mm"],
        inner_groove_radius=0.515 * size["ball_diameter_mm"],
        outer_groove_radius=0.525 * size["ball_diameter_mm"],
        bore=size["bore_mm"],
        outside_diameter=size["outside_diameter_mm"],
    )
    assert case.friction is not None  # of every bearing case
    return replace(case, bearing=bearing, friction=replace(case.friction, static_rating=1e3 * STATIC_RATINGS[name]))


def page() -> str:
    """The page, computed anew."""
    skf, lines, ratios = tables()
    gaps = [100.0 * (1.0 - ratios[stem]) for stem in ("6206_axial_500N", "6206_combined_1000N")]
    axial = CASES["6206_axial_500N"]
    control, half = (
        total(solved(axial, 500.0, (500.0, 0.0), kinematics=k)[0], "pure_rolling_lines")
        for k in (BallKinematics.OUTER_RACE_CONTROL, BallKinematics.HALF_AND_HALF)
    )
    _, state, contacts = solved(axial, 500.0, (500.0, 0.0))
    spin = abs(balanced_friction(state, contacts, 0.1).kinematics[0, :, 2])
    rows = [*figures_6_to_9(), *figures_10_to_16()]
    return TEMPLATE.read_text(encoding="utf-8").format(
        skf=skf,
        lines=lines,
        least=min(gaps),
        most=max(gaps),
        radial=100.0 * ratios["6206_radial_500N"],
        true_radial=100.0 * ratios["6206_radial_500N true"],
        choices=choices(),
        errors=line_errors(),
        statements="\n".join("| " + " | ".join(row) + " |" for row in rows),
        free=100.0 * (1.0 - ratios[f"{COMBINED} free"]),
        free_true=100.0 * (1.0 - ratios[f"{COMBINED} free true"]),
        figure_15=figure_15(),
        inner=100.0 * spin[0] / spin.sum(),
        control=control,
        half=half,
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
