"""How the value of a key is distributed: ranges and laws of blocks of samples."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ehl.arrays import Array

from ...format.fields import is_number
from ...format.problems import CaseProblem, shown
from .blocks import Setting

FORMS = {  # numbers of each law
    "uniform": "[first, last]",
    "normal": "[mean, standard deviation]",
    "truncated_normal": "[mean, standard deviation, first, last]",
    "lognormal": "[median, standard deviation of the logarithm]",
    "triangular": "[first, mode, last]",
}
RANGE = "allowed: [first, last], two numbers, first < last"
ALLOWED = "allowed: [first, last], or one of " + ", ".join(
    f"{{ {name} = {form} }}" for name, form in FORMS.items()
)


@dataclass(frozen=True, slots=True)
class Distribution:
    """Values of a key by their shares: `inverse` is the quantile function."""

    inverse: Callable[[Array], Any]
    bounded: bool

    def values(self, probabilities: Array) -> list[Any]:
        """Quantiles of the distribution.

        Parameters
        ----------
        probabilities : Array
            Cumulative probabilities between 0 and 1, shape (n,) [-].

        Returns
        -------
        list[Any]
            Values in the unit of the key.
        """
        found: list[Any] = np.asarray(self.inverse(probabilities)).tolist()
        return found


def with_law(setting: Setting) -> Setting:
    """A key with its law as value, where the name of the law was read as the end of the key.

    Parameters
    ----------
    setting : Setting
        Key and value as read.

    Returns
    -------
    Setting
        The setting with the key of the case.
    """
    key, _, law = setting.key.rpartition(".")
    if law not in FORMS:
        return setting
    return Setting(key, setting.where[:-1], {law: setting.value})


def distribution(setting: Setting, *, laws: bool = True) -> Distribution | CaseProblem:
    """The distribution that a block gives a key.

    Parameters
    ----------
    setting : Setting
        Key and value of the block.
    laws : bool, default True
        False: ranges only.

    Returns
    -------
    Distribution | CaseProblem
        The distribution, or the problem of the value.
    """
    given = setting.value
    name: Any = "uniform"
    numbers: Any = given
    if isinstance(given, dict) and len(given) == 1:
        name, numbers = next(iter(given.items()))
    known = (
        name in FORMS
        and (laws or name == "uniform")
        and isinstance(numbers, list)
        and all(map(is_number, numbers))
    )
    if known and len(numbers) == FORMS[name].count(",") + 1 and _is_valid(name, numbers):
        return _from_numbers(name, numbers)
    return CaseProblem(setting.where, f"found {shown(given)}", ALLOWED if laws else RANGE)


def _is_valid(name: str, numbers: list[float]) -> bool:
    """Tell whether ends are in order and spreads positive."""
    if name == "uniform":
        return numbers[0] < numbers[1]
    if name == "triangular":
        return numbers[0] <= numbers[1] <= numbers[2] and numbers[0] < numbers[2]
    if name == "lognormal":
        return numbers[0] > 0 and numbers[1] > 0
    return numbers[1] > 0 and (name == "normal" or numbers[2] < numbers[3])


def _from_numbers(name: str, numbers: list[float]) -> Distribution:
    """A law by its numbers; whole numbers as both ends of a range give whole numbers."""
    from scipy import stats

    if name == "uniform" and all(isinstance(number, int) for number in numbers):
        return Distribution(partial(_whole, int(numbers[0]), int(numbers[1])), True)
    if name == "uniform":
        return Distribution(stats.uniform(numbers[0], numbers[1] - numbers[0]).ppf, True)
    if name == "normal":
        return Distribution(stats.norm(*numbers).ppf, False)
    if name == "lognormal":
        return Distribution(stats.lognorm(numbers[1], scale=numbers[0]).ppf, False)
    if name == "truncated_normal":
        mean, spread, first, last = numbers
        ends = ((first - mean) / spread, (last - mean) / spread)
        return Distribution(stats.truncnorm(*ends, loc=mean, scale=spread).ppf, True)
    first, mode, last = numbers
    width = last - first
    return Distribution(stats.triang((mode - first) / width, loc=first, scale=width).ppf, True)


def _whole(first: int, last: int, probabilities: Array) -> Any:
    """Whole numbers from the first to the last, each as likely."""
    count = last - first + 1
    return first + np.minimum(np.floor(probabilities * count).astype(int), count - 1)


def correlated(probabilities: Array, matrix: Array) -> Array:
    """Probabilities with a Gaussian copula.

    Parameters
    ----------
    probabilities : Array
        Independent probabilities, shape (n, keys) [-].
    matrix : Array
        Correlation matrix of the normal scores, shape (keys, keys) [-].

    Returns
    -------
    Array
        Correlated probabilities, shape (n, keys) [-].
    """
    from scipy import stats

    scores = stats.norm.ppf(probabilities) @ np.linalg.cholesky(matrix).T
    return stats.norm.cdf(scores)
