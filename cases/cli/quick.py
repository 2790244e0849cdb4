"""Commands that answer at once: hertz, frequencies, and the live program: app."""

from __future__ import annotations

from importlib.util import find_spec
from math import isfinite
from typing import Annotated, Any

import typer

from ..format.rules import CaseError
from ..runs.interrupt import print_message
from .terminal import Answer, command, print_json, print_lines

NEEDED = ("trame_vtk", "trame_client", "aiohttp")
Silent = Annotated[bool, typer.Option("--quiet", "-q", help="Numbers only, no notes.")]
STEEL = "bearing steel"
NAMES = {
    "cage": "cage",
    "ball_pass_outer": "ball pass, outer ring (BPFO)",
    "ball_pass_inner": "ball pass, inner ring (BPFI)",
    "ball_spin": "ball spin (BSF)",
    "twice_ball_spin": "twice the ball spin (2 BSF)",
}


@command()
def hertz(
    bearing: Annotated[
        str | None,
        typer.Argument(
            metavar="[DESIGNATION|CASE]", help="A bearing; left out: a contact by --radius-x."
        ),
    ] = None,
    load: Annotated[
        float | None, typer.Option("--load", help="Of the contact, or of a ball [N].")
    ] = None,
    radial: Annotated[float | None, typer.Option(help="Of the bearing [N].")] = None,
    axial: Annotated[float | None, typer.Option(help="Of the bearing [N].")] = None,
    angle: Annotated[
        float | None, typer.Option(help="Contact angle of a ball [deg]; default: the free one.")
    ] = None,
    radius_x: Annotated[
        float | None, typer.Option(help="Reduced radius along x, that of rolling [mm].")
    ] = None,
    radius_y: Annotated[
        float | None, typer.Option(help="Across it [mm]; default: the same, a circle.")
    ] = None,
    modulus: Annotated[
        float | None, typer.Option(help="E' [GPa], 2/E' = (1 - nu^2)/E of both bodies summed.")
    ] = None,
    material_1: Annotated[str, typer.Option(help="Of body 1, in place of --modulus.")] = STEEL,
    material_2: Annotated[str, typer.Option(help="Of body 2.")] = STEEL,
    as_json: Answer = False,
    quiet: Silent = False,
) -> None:
    """Ellipse, pressure and approach of dry contacts after Hertz: by numbers, or of a bearing."""
    given = {
        "load": load, "radial": radial, "axial": axial, "angle": angle,
        "radius-x": radius_x, "radius-y": radius_y, "modulus": modulus,
    }  # fmt: skip
    _check_finite(given)
    if bearing is not None:
        more = [
            f"--{key}" for key in ("radius-x", "radius-y", "modulus") if given[key] is not None
        ]
        if more:
            raise CaseError(f"oilfilm hertz: {', '.join(more)} beside a bearing; allowed: without")
        from .answers import hertz_answer

        try:
            answer = hertz_answer(bearing, load, radial, axial, angle)
        except CaseError:
            raise
        except ValueError as error:
            raise CaseError(f"oilfilm hertz: {error}") from None
    else:
        answer = _contact_by_numbers(load, radius_x, radius_y, modulus, (material_1, material_2))
    if as_json:
        print_json(answer)
        return
    for line in _contact_lines(answer["contacts"]):
        print_lines(line)
    _print_notes(answer, quiet=quiet)


def _contact_by_numbers(
    load: float | None,
    radius_x: float | None,
    radius_y: float | None,
    modulus: float | None,
    names: tuple[str, str],
) -> dict[str, Any]:
    missing = [
        option for option, value in (("--load", load), ("--radius-x", radius_x)) if value is None
    ]
    if load is None or radius_x is None:
        raise CaseError(
            f"oilfilm hertz: {', '.join(missing)} needed: load [N] and reduced radii [mm] of a "
            "contact; or a bearing, as in 'oilfilm hertz 6208 --radial 3000'"
        )
    from oilfilm.bearing.material import load_material, reduced_modulus
    from oilfilm.ehl.closed_form.hertz import hertz_contact
    from oilfilm.ehl.units import to_si
    from oilfilm.ehl.version import version

    from .answers import contact_answer

    try:
        bodies = [load_material(name) for name in names]
        stiff = reduced_modulus(*bodies) if modulus is None else to_si("E_GPa", modulus)
        other = radius_x if radius_y is None else radius_y
        contact = hertz_contact(load, to_si("r_mm", radius_x), to_si("r_mm", other), stiff)
    except ValueError as error:
        raise CaseError(f"oilfilm hertz: {error}") from None
    return {"oilfilm": version(), "contacts": [contact_answer(contact)], "messages": []}


@command()
def frequencies(
    bearing: Annotated[
        str, typer.Argument(metavar="DESIGNATION|CASE", help="A bearing, as 6306-2Z/C3.")
    ],
    speed: Annotated[
        float | None, typer.Option(help="Of the inner ring [r/min]; default: the case's.")
    ] = None,
    outer_speed: Annotated[float | None, typer.Option(help="Of the outer ring [r/min].")] = None,
    angle: Annotated[
        float | None, typer.Option(help="Contact angle [deg]; default: the nominal one.")
    ] = None,
    as_json: Answer = False,
    quiet: Silent = False,
) -> None:
    """Frequencies of cage, ball passage and ball spin, with the interval of an estimate."""
    _check_finite({"speed": speed, "outer-speed": outer_speed, "angle": angle})
    from .answers import frequencies_answer

    answer = frequencies_answer(bearing, speed, outer_speed, angle)
    if as_json:
        print_json(answer)
        return
    for line in _frequency_lines(answer):
        print_lines(line)
    _print_notes(answer, quiet=quiet)


@command()
def app(
    case: Annotated[
        str,
        typer.Argument(
            metavar="[CASE|DESIGNATION]", help="A case file, a shipped case, or a bearing."
        ),
    ] = "6208",
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port on this computer; 0: a free one.")
    ] = 0,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the address, open nothing.")
    ] = False,
    keep: Annotated[
        bool, typer.Option("--keep", help="Stay when the page is closed, until Ctrl-C.")
    ] = False,
) -> None:
    """Open a page whose films, torque, temperature and life follow its controls."""
    if any(find_spec(name) is None for name in NEEDED):
        raise CaseError("oilfilm app needs its extra: pip install 'oilfilm[app]'")
    from ..app.design import start

    design = start(case)
    if not {"bearing", "shaft"}.intersection(design.document):
        raise CaseError(
            f"{case}: no bearing; allowed: a case of a bearing or a shaft, a designation"
        )
    print_message("oilfilm app: starting; the address follows")
    from ..app.server import run_app

    try:
        run_app(design, port, browser=not no_browser, keep=keep)
    except KeyboardInterrupt:
        print_message("oilfilm app: ended")
    except OSError as error:
        raise CaseError(f"oilfilm app: --port {port}: {error.strerror or error}") from None


def _check_finite(options: dict[str, float | None]) -> None:
    for key, value in options.items():
        if value is not None and not isfinite(value):
            raise CaseError(f"--{key}: found {value:g}; allowed: a finite number")
    angle = options.get("angle")
    if angle is not None and not 0.0 <= angle < 90.0:
        raise CaseError(f"--angle: found {angle:g} deg; allowed: from 0, below 90")


def _contact_lines(contacts: list[dict[str, Any]]) -> list[str]:
    """One line a value, one column a contact."""
    lines = []
    for key in contacts[0]:
        values = [contact[key] for contact in contacts]
        shown = [f"{value:.5g}" if isinstance(value, float) else value for value in values]
        lines.append(f"{key:24}" + "".join(f"{text:>12}" for text in shown))
    return lines


def _frequency_lines(answer: dict[str, Any]) -> list[str]:
    relative = answer["per_turn"] or {}
    lines = []
    for key, words in NAMES.items():
        line = f"{words:30}{answer['frequencies_Hz'][key]:>12.6g} Hz"
        if key in relative:
            line += f"{relative[key]:>10.5g} a turn"
        if answer["ranges_Hz"] is not None:
            low, high = answer["ranges_Hz"][key]
            line += f"   {low:.5g} to {high:.5g} Hz"
        lines.append(line)
    return lines


def _print_notes(answer: dict[str, Any], *, quiet: bool) -> None:
    for message in () if quiet else answer["messages"]:
        print_message(f"note: {message}")
