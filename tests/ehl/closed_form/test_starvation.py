"""What little oil leaves of a flooded contact."""

from __future__ import annotations

import pytest

from ehl.closed_form.starvation import rolling_share_biboulet_houpert, starvation_shares


def test_rolling_moment_of_starved_line_contacts():
    """Biboulet and Houpert (2010): 0.20 at S 2, 0.37 at 5, 0.53 at 10, 0.79 at 50."""
    values = [rolling_share_biboulet_houpert(s) for s in (2.0, 5.0, 10.0, 50.0)]
    assert values == pytest.approx([0.20, 0.37, 0.53, 0.79], abs=0.006)
    assert rolling_share_biboulet_houpert(1e12) == pytest.approx(1.0)
    assert rolling_share_biboulet_houpert(1.0) == pytest.approx(rolling_share_biboulet_houpert(1.0 + 1e-12))


@pytest.mark.parametrize("ratio", [0.05, 1.0])
def test_much_oil_leaves_all_and_little_goes_through(ratio):
    shares = [starvation_shares(200.0, 10.0, ratio, r) for r in (0.05, 0.5, 2.0, 20.0, 1e9)]
    for name in ("central", "minimum", "rolling_moment"):
        values = [getattr(one, name).value for one in shares]
        assert values == sorted(values) and values[-1] <= 1.0
        assert values[-1] == pytest.approx(1.0, abs=1e-3)
    assert shares[0].central.value == pytest.approx(0.05, rel=2e-3)


@pytest.mark.parametrize("given", [(0.0, 1.0, 1.0, 1.0), (1.0, -1.0, 1.0, 1.0), (1.0, 1.0, 1.0, -1.0)])
def test_a_contact_has_positive_groups(given):
    with pytest.raises(ValueError, match="must be"):
        starvation_shares(*given)
