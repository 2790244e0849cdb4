"""Hertz contacts of many balls at once against those one by one."""

from __future__ import annotations

from dataclasses import astuple

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.bearing.contacts.contact import ellipse_ratios, hertz_contacts
from oilfilm.ehl.closed_form.hertz import ellipse_ratio, hertz_contact


def test_ratios_of_the_semi_axes_are_those_found_one_by_one():
    """Over sixteen decades of Rx/Ry, at the circle and next to it."""
    rng = np.random.default_rng(20941)
    ratios = np.concatenate([10.0 ** rng.uniform(-8.0, 8.0, 200), [1.0, 1.0 + 1e-9, 1.0 - 1e-6, 1.00002, 0.9999]])
    assert_allclose(ellipse_ratios(ratios), [ellipse_ratio(float(ratio)) for ratio in ratios], rtol=1e-13)


def test_contacts_are_those_of_one_by_one():
    rng = np.random.default_rng(77302)
    inputs = rng.uniform((1.0, 3e-3, 4e-3, 1e11), (9000.0, 0.02, 0.9, 4e11), (40, 4))
    found = hertz_contacts(*inputs.T)
    for contact, values in zip(found, inputs, strict=True):
        expected = hertz_contact(*(float(value) for value in values))
        assert_allclose(astuple(contact), astuple(expected), rtol=1e-13)
        assert all(type(value) is float for value in astuple(contact))


def test_no_contact_makes_none():
    assert hertz_contacts(*np.empty((4, 0))) == []
