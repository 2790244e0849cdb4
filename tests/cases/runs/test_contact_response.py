"""Stiffness and damping of a single contact: keys, reasons where there are none, frequencies refused."""

from __future__ import annotations

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.runs.contact import run_contact
from oilfilm.postprocess.contact.summary import contact_summary, response_row

TEXT = """schema_version = 1
[contact]
load_N = 200.0
radius_x_mm = 6.0
radius_y_mm = 60.0
reduced_modulus_GPa = 226.0
entrainment_speed_m_s = 5.0
[lubricant]
viscosity_mPa_s = 30.0
pressure_viscosity_1_GPa = 20.0
{oil}
[ehl]
points = 129
{ehl}
"""


def summary(oil="", ehl=""):
    results = run_contact(case_from_text(TEXT.format(oil=oil, ehl=ehl), "c.toml"))
    return results, contact_summary(results)


def test_values_with_bars_and_over_frequency():
    """Below Hertz' stiffness; at 5 kHz stiffer and less damped; the finest mesh of 257 and 129 points in the bars."""
    results, found = summary(ehl="response_frequencies_Hz = [1.0, 5e3]")
    assert abs(found["stiffness_N_um"] - 69.36) < found["stiffness_uncertainty_N_um"] < 1.0
    assert abs(found["damping_N_s_m"] - 131.1) < found["damping_uncertainty_N_s_m"] < 15.0
    response = found["response"]
    assert response["frequency_Hz"] == [1.0, 5e3]
    assert response["stiffness_N_um"][0] == found["stiffness_N_um"] < response["stiffness_N_um"][1]
    assert response["damping_N_s_m"][0] == found["damping_N_s_m"] > response["damping_N_s_m"][1] > 0.0
    assert "N/µm" in response_row(results.response)


@pytest.mark.parametrize("starvation", ["tabulated", "solved"])
def test_behind_a_layer_slow_movement_is_excited(starvation):
    """Stiffer than flooded; a damping below zero is said, at 3 kHz it is above."""
    ehl = f'starvation = "{starvation}"\nresponse_frequencies_Hz = [3e3]'
    found = summary(oil="inlet_film_um = 0.5", ehl=ehl)[1]
    assert 69.5 < found["stiffness_N_um"] < 72.0
    assert found["damping_N_s_m"] < 0.0 < found["response"]["damping_N_s_m"][0] < 131.1
    assert any(text.startswith("damping_N_s_m: negative") for text in found["messages"])


def test_null_with_shear_thinning_with_its_reason():
    """A film with shear has no linear response, and the messages say so."""
    oil = 'rheology = "ree-eyring"\neyring_stress_MPa = 5.0'
    results, found = summary(oil=oil, ehl='film_model = "shear-thinning"')
    assert results.response is None
    assert found["stiffness_N_um"] is None and found["response"] is None
    reason = "stiffness_N_um, damping_N_s_m, response: null, the film was solved with shear or heat"
    assert reason in found["messages"]
    assert response_row(results.response) == ""


@pytest.mark.parametrize("frequency", ["1e8", "-1.0", "0.0"])
def test_frequencies_beyond_a_mesh_are_refused(frequency):
    """Before anything is computed, by the key."""
    with pytest.raises(CaseError, match="response_frequencies_Hz"):
        summary(ehl=f"response_frequencies_Hz = [{frequency}]")
