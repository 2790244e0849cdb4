"""A time simulation in the terminal."""

from typing import Any

from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text


def dynamics_table(document: dict[str, Any]) -> Group:
    """What a simulation found, from its summary, for a terminal: speeds [r/min], energies [J],
    contact states [-].
    """
    facts = Table(box=None, show_header=False, pad_edge=False)
    for name, value in _facts(document):
        facts.add_row(name, value)
    title = "share of the time at the inner race, and at the outer race; largest load"
    states = Table(
        box=box.SIMPLE_HEAD, pad_edge=False, title=title, title_justify="left", title_style=""
    )
    headers = ("ball", "free", "contact", "impact", "N", "free", "contact", "impact", "N")
    for header in headers:
        states.add_column(header, justify="right", no_wrap=True)
    for ball in document["balls"]:
        cells = [str(ball["ball"])]
        for race in ("inner", "outer"):
            part = ball[race]
            cells += [f"{part[state]:.3f}" for state in ("free", "contact", "impact")]
            cells.append(f"{part['largest_load_N']:.3g}")
        states.add_row(*cells)
    return Group(Text(str(document["case"].get("title", "")), style="bold"), facts, states)


def _facts(document: dict[str, Any]) -> list[tuple[str, str]]:
    counts = document["equation_counts"]
    parts = f"{counts['ring']} ring + {counts['cage']} cage + {counts['balls']} balls"
    facts = [
        ("equations", f"{document['equations']} ({document['load_type']}: {parts})"),
        (
            "simulated",
            f"{document['simulated_s']:.6g} s in {document['wall_s']:.1f} s, {document['steps']} steps",
        ),
    ]
    if document["cage_speed_rpm"] is None:
        return facts
    ratio = document["cage_speed_ratio"]
    of_kinematic = (
        ""
        if ratio is None
        else f", {ratio:.4f} of the kinematic {document['kinematic_cage_speed_rpm']:.2f}"
    )
    width = document["cage_speed_interval_rpm"]
    within = "" if width is None else f" ± {width:.2g}"
    facts.append(("cage", f"{document['cage_speed_rpm']:.2f}{within} r/min{of_kinematic}"))
    lost = document["energy"]["dissipated_J"]
    put_in = sum(document["energy"]["input_J"].values())
    largest = sorted(lost, key=lambda name: -abs(lost[name]))[:3]
    words = ", ".join(f"{name.replace('_', ' ')} {lost[name]:.3g}" for name in largest)
    facts.append(("energy", f"{put_in:.4g} J in, {sum(lost.values()):.4g} J lost ({words})"))
    if films := document["energy"]["films_J"]:
        facts.append(
            (
                "films",
                f"{abs(films):.3g} J {'taken up' if films > 0.0 else 'given, lifting balls'}",
            )
        )
    facts.append(("balance", f"off by {document['energy_balance_error']:.1e} of the work"))
    return facts
