"""The result of `oilfilm.run`: its main numbers in SI, its summary, its contacts as a frame, its
pictures.
"""

from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import pandas

from oilfilm.ehl.units import from_si, to_si

from .bearing.plots import draw_load_zone, draw_per_azimuth
from .bearing.results import BearingResults
from .bearing.summary import hours
from .contact.plots import contact_view, draw_contact
from .contact.summary import ContactResults
from .plot_style import figure_of
from .run_numbers import summary
from .writer import write_results

SELF_HEATED = "self-heated"  # of [operation] temperature
WIDTH = 14  # of the names in the text of a result
PICTURES = ("film", "pressure", "load_zone")


@dataclass(frozen=True, eq=False)  # without slots, which would keep no cached property
class RunResult:
    """One bearing or contact as `oilfilm.run` computed it; numbers in SI.

    Attributes
    ----------
    results : BearingResults | ContactResults
        Everything that was computed, as `run_case` and `run_contact` return it.

    Examples
    --------
    >>> import oilfilm
    >>> result = oilfilm.run("moes_20_10")
    >>> result.converged, result.summary["moes_M"]
    (True, 20.0)
    """

    results: BearingResults | ContactResults

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The content of `summary.json`, keys in their units."""
        return summary(self.results)

    @property
    def converged(self) -> bool:
        """True if every part converged."""
        return bool(self.summary["converged"])

    @property
    def messages(self) -> list[str]:
        """Warnings and remarks."""
        return list(self.summary["messages"])

    @property
    def contacts(self) -> list[dict[str, Any]]:
        """Contacts, keys in their units; of a single contact the one."""
        return list(self.summary.get("contacts", (self.summary,)))

    @property
    def film_minimum(self) -> float | None:
        """Least film of all contacts [m]; None where no film converged, or in Moes' groups."""
        return self._over_contacts("film_minimum_um", min)

    @property
    def film_central(self) -> float | None:
        """Central film of the contact where it is the least [m]."""
        return self._over_contacts("film_central_um", min)

    @property
    def pressure_maximum(self) -> float | None:
        """Largest Hertz pressure [Pa]."""
        return self._over_contacts("hertz_pressure_GPa", max)

    @property
    def torque(self) -> float | None:
        """Friction torque of a bearing [N m]; None of a contact, or where it is not known."""
        total = (self.summary.get("torque_N_mm") or {}).get("total")
        return None if total is None else float(to_si("torque_N_mm", total))

    @property
    def temperature(self) -> float | None:
        """Temperature of the oil at the inlets: of the heat balance, or as given [K]."""
        case = self.summary["case"]
        operation = case.get("operation") or case.get("contact", {})
        celsius = operation.get("temperature_C")
        heating = self.summary.get("self_heating") or {}
        if (
            operation.get("temperature") == SELF_HEATED
            and heating.get("temperature_C") is not None
        ):
            celsius = heating["temperature_C"]
        return None if celsius is None else float(to_si("temperature_C", celsius))

    def _over_contacts(self, key: str, choose: Any) -> float | None:
        values = [contact.get(key) for contact in self.contacts]
        found = [value for value in values if value is not None]
        return float(to_si(key, choose(found))) if found else None

    def to_dataframe(self) -> pandas.DataFrame:
        """The contacts, a row each, the columns those of `contacts.csv`, in the units of their
        names.
        """
        return pandas.json_normalize(self.contacts)

    def plot(self, picture: str = "film") -> Any:
        """Draw the films of all contacts.

        Parameters
        ----------
        picture : str, default "film"
            "film", "pressure" or "load_zone"; of a single contact film and pressure are one.

        Returns
        -------
        matplotlib.figure.Figure
            Picture, which shows itself in a notebook and has `savefig`.

        Raises
        ------
        ValueError
            If there is no such picture.
        """
        if picture not in PICTURES:
            raise ValueError(f"picture must be one of {', '.join(PICTURES)}, got {picture!r}")
        if isinstance(self.results, ContactResults):
            view = contact_view(self.results.solution)
            draw: Any = partial(draw_contact, view=view, title=self.results.title)
        elif picture == "load_zone":
            draw = partial(draw_load_zone, results=self.results)
        else:
            draw = partial(draw_per_azimuth, results=self.results, quantity=picture)
        return figure_of(draw)

    def write(self, directory: str | Path) -> tuple[str, ...]:
        """Write all files of a run, as `write_results` does.

        Parameters
        ----------
        directory : str | Path
            Folder to write into.

        Returns
        -------
        tuple[str, ...]
            What could not be drawn, and why.
        """
        return write_results(self.results, directory)

    def __repr__(self) -> str:
        """Ten lines at most."""
        summary = self.summary
        operation = summary["case"].get("operation", {})
        speed = operation.get("inner_speed_rpm")
        rated = (summary.get("life") or {}).get("modified_reference_rating_h")
        loaded = [contact for contact in self.contacts if contact.get("loaded", True)]
        ratios = [c["lambda_ratio"] for c in loaded if c.get("lambda_ratio") is not None]
        kelvin = self.temperature
        rows = {
            "speed": None if speed is None else f"{speed:g} r/min",
            "load": _loads(operation),
            "minimum film": _scaled(self.film_minimum, 1e6, "µm"),
            "lambda": f"{min(ratios):.3g}" if ratios else None,
            "Hertz pressure": _scaled(self.pressure_maximum, 1e-9, "GPa"),
            "torque": _scaled(self.torque, 1e3, "N mm"),
            "temperature": None if kelvin is None else f"{from_si('oil_C', kelvin):.1f} °C",
            "life": None if rated is None else hours(rated),
            "notes": f"{len(self.messages)}, in .messages; all numbers in .summary",
        }
        state = "converged" if self.converged else "NOT converged"
        lines = [f"{self.results.title or type(self.results).__name__}: {state}"]
        return "\n".join(
            lines + [f"{name:{WIDTH}}  {text}" for name, text in rows.items() if text is not None]
        )

    def _repr_html_(self) -> str:
        """The tables of the results, for a notebook."""
        return self.results._repr_html_()


def _scaled(value: float | None, factor: float, unit: str) -> str | None:
    return None if value is None else f"{factor * value:.4g} {unit}"


def _loads(operation: dict[str, Any]) -> str | None:
    """Radial and axial load as given; None where they are given otherwise."""
    loads = {name: operation.get(f"{name}_load_N") for name in ("radial", "axial")}
    given = [f"{value:g} N {name}" for name, value in loads.items() if value]
    return ", ".join(given) or None
