"""The second solution of contacts behind a layer of oil, beside the multigrid and by itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from verification.starvation.cells import Deflection, cells_of
from verification.starvation.comparison import CONTACTS, shares_by_multigrid, shares_by_newton
from verification.starvation.newton import Fields, _Problem, hertz_start, solve

from oilfilm.ehl.scaling import scale_contact

SMALL = (replace(CONTACTS[0], cells=(76, 36)), replace(CONTACTS[3], cells=(82, 36)))


@pytest.mark.parametrize("contact", SMALL, ids=["circle", "ellipse"])
def test_both_solutions_have_the_same_shares(contact):
    """Coarse: 1 % of R, 2.5 % of R_min."""
    ratios = (0.8,)
    for r, theirs in zip(ratios, shares_by_newton(contact, ratios), strict=True):
        ours = shares_by_multigrid(contact, 129, r)
        assert ours.central == pytest.approx(theirs.central, rel=0.01)
        assert ours.minimum == pytest.approx(theirs.minimum, rel=0.025)
        assert ours.meniscus == pytest.approx(theirs.meniscus, abs=0.08)
        assert ours.outlet == pytest.approx(theirs.outlet, rel=0.02)
        assert theirs.central < r


def test_newton_balances_its_oil():
    contact = scale_contact(CONTACTS[0].conditions)
    cells = cells_of((-4.0, 1.5, 2.5), 60, 24)
    solved = solve(contact, cells, 0.2, hertz_start(contact, cells, 0.2))
    fields = solved.fields
    assert solved.residual < 1e-9
    assert abs(solved.balance) < 1e-12
    assert ((fields.P == 0.0) | (fields.theta == 1.0)).all()
    assert fields.theta.min() > 0.0 and fields.P.min() == 0.0
    entering = 0.2 * cells.Y.size
    assert solved.outlet.sum() == pytest.approx(entering, rel=1e-9)  # no pressure on the edges


def test_slopes_of_the_residual():
    """By difference quotients."""
    contact = scale_contact(CONTACTS[0].conditions)
    cells = cells_of((-4.0, 1.5, 2.0), 24, 12)
    problem = _Problem(contact, cells, np.full(12, 0.3))
    random = np.random.default_rng(5)
    fields = Fields(P=0.3 * random.random((12, 24)), theta=0.3 + 0.5 * random.random((12, 24)), approach=0.2)
    H = problem.gap(fields)
    before, slopes, _ = problem.residual(fields, H)
    change = random.standard_normal((12, 24))
    for by, moved, gap in (
        (slopes.by_P, replace(fields, P=fields.P + 1e-6 * change), H),
        (slopes.by_H, fields, H + 1e-6 * change),
        (slopes.by_theta, replace(fields, theta=fields.theta + 1e-6 * change), H),
    ):
        after, _, _ = problem.residual(moved, gap)
        expected = by @ change.ravel()
        assert np.abs((after - before) / 1e-6 - expected).max() < 1e-4 * np.abs(expected).max()


def test_deflection_of_cells():
    """Of Hertz' pressure at the centre and at the edge of a circle: 1 and a half, in units of a^2/R."""
    contact = scale_contact(CONTACTS[0].conditions)
    cells = cells_of((-2.0, 2.0, 2.0), 160, 80)
    deflection = Deflection(cells, contact.deformation)
    found = deflection(contact.dry_pressure(cells.X[None, :], cells.Y[:, None]))
    assert np.interp(0.0, cells.X, found[0]) == pytest.approx(1.0, rel=2e-3)
    assert np.interp(1.0, cells.X, found[0]) == pytest.approx(0.5, rel=4e-3)
    near = deflection.near()
    one = np.zeros((80, 160))
    one[0, 80] = 1.0
    assert (near @ one.ravel()).reshape(one.shape)[0, 79:82] == pytest.approx(deflection(one)[0, 79:82], rel=1e-12)
