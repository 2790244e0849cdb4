"""Points drawn at random: Latin hypercubes, Sobol sequences, designs of Morris and of Saltelli.

The value of a key has a range, or a distribution.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.postprocess.batch.design import Design

from ..format.fields import is_number, validated
from ..format.rules import CaseProblem, KeyPath, shown
from .plan import Sampled, Setting, block_settings
from .sweep_file import HypercubeOptions, MorrisOptions, SampleOptions, SobolOptions, SweepFile

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

# levels of Morris' designs at the ends of a law without ends: its quantiles of 2.5 and 97.5 %
OUTER = 0.025
Options = HypercubeOptions | SampleOptions | MorrisOptions | SobolOptions


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


def sampled_blocks(file: SweepFile) -> tuple[list[tuple[Sampled, Design]], list[CaseProblem]]:
    """Blocks of points that are drawn at random, in the order of the format's description.

    Parameters
    ----------
    file : SweepFile
        The checked sweep file.

    Returns
    -------
    blocks
        Points of each block and its design.
    problems
        Wrong values.
    """
    tables: list[tuple[str, dict[str, Any], type[Options], KeyPath]] = []
    several: dict[str, type[Options]] = {
        "latin_hypercube": HypercubeOptions,
        "sample": SampleOptions,
    }
    single: dict[str, type[Options]] = {"morris": MorrisOptions, "sobol_indices": SobolOptions}
    for name, kind in several.items():
        given = getattr(file, name)
        where = [(name, k) if len(given) > 1 else (name,) for k in range(len(given))]
        tables += [(name, table, kind, place) for table, place in zip(given, where, strict=True)]
    for name, kind in single.items():
        table = getattr(file, name)
        tables += [] if table is None else [(name, table, kind, (name,))]
    blocks = []
    faults: list[CaseProblem] = []
    for name, table, kind, place in tables:
        options = _options(kind, table, place)
        if isinstance(options, list):
            faults += options
            continue
        block, design, wrong = sampled_block(name, table, options, place)
        blocks.append((block, design))
        faults += wrong
    return blocks, faults


def _options(
    kind: type[Options], table: dict[str, Any], where: KeyPath
) -> Options | list[CaseProblem]:
    """The options of a block, or their faults."""
    given = {key: table[key] for key in kind.model_fields if key in table}
    options, faults = validated(kind, given)
    if options is None:
        return [CaseProblem((*where, *p.path), p.finding, p.allowed) for p in faults]
    two = isinstance(options, SobolOptions) or getattr(options, "method", "") == "sobol"
    if two and not isinstance(options, MorrisOptions) and options.samples.bit_count() != 1:
        near = 2 ** round(math.log2(options.samples))
        allowed = f"allowed: a power of 2, as {near}"
        return [CaseProblem((*where, "samples"), f"found {options.samples}", allowed)]
    return options


def sampled_block(
    name: str, table: dict[str, Any], options: Options, where: KeyPath
) -> tuple[Sampled, Design, list[CaseProblem]]:
    """The points of one block and the design that they form.

    Parameters
    ----------
    name : str
        Name of the block.
    table : dict[str, Any]
        Keys and options as parsed.
    options : Options
        The checked options.
    where : KeyPath
        Path of the block in the file.

    Returns
    -------
    points
        The points; none where a value is wrong.
    design
        Keys, samples and ranges.
    problems
        Wrong values.
    """
    own = set(type(options).model_fields)
    given = block_settings({k: v for k, v in table.items() if k not in own}, where)
    settings = [with_law(setting) for setting in given]
    any_law = not isinstance(options, HypercubeOptions)
    laws = [distribution(setting, laws=any_law) for setting in settings]
    faults = [law for law in laws if isinstance(law, CaseProblem)]
    known = [law for law in laws if isinstance(law, Distribution)]
    if not settings:
        faults.append(CaseProblem(where, "no keys", "needed: keys with their [first, last]"))
    keys = tuple(setting.key for setting in settings)
    matrix = np.eye(len(keys))
    if isinstance(options, SampleOptions):
        matrix, wrong = _correlations(options, keys, where)
        faults += wrong
    design = Design(block=name, keys=keys, samples=_runs(options))
    if faults:
        return Sampled(name, [], []), design, faults
    probabilities = _unit_design(options, len(keys))
    if isinstance(options, SampleOptions):
        probabilities = (
            correlated(probabilities, matrix) if options.correlations else probabilities
        )
    elif isinstance(options, MorrisOptions):
        probabilities = np.column_stack(
            [_inside(s, law) for s, law in zip(probabilities.T, known, strict=True)]
        )
    ends = [law.values(_inside(np.array([0.0, 1.0]), law)) for law in known]
    design = replace(design, ranges=tuple((float(low), float(high)) for low, high in ends))
    columns = [law.values(column) for law, column in zip(known, probabilities.T, strict=True)]
    places = [(setting.key, setting.where) for setting in settings]
    return Sampled(name, places, list(zip(*columns, strict=True))), design, []


def _inside(probabilities: Array, law: Distribution) -> Array:
    """Levels of a law: the quantiles between its outer ones where it has no ends."""
    return probabilities if law.bounded else OUTER + (1.0 - 2.0 * OUTER) * probabilities


def _runs(options: Options) -> int:
    return options.trajectories if isinstance(options, MorrisOptions) else options.samples


def _unit_design(options: Options, keys: int) -> Array:
    """Places of all points in the unit cube, shape (points, keys)."""
    if isinstance(options, MorrisOptions):
        return morris_design(keys, options.trajectories, options.levels, options.seed)
    if isinstance(options, SobolOptions):
        return saltelli_design(keys, options.samples, options.seed)
    method = options.method if isinstance(options, SampleOptions) else "latin hypercube"
    return unit_sample(method, keys, options.samples, options.seed)


def unit_sample(method: str, keys: int, samples: int, seed: int) -> Array:
    """A sample of the unit cube.

    A Latin hypercube (McKay, Beckman and Conover 1979), a scrambled Sobol sequence (Owen 1998), or
    random points.

    Parameters
    ----------
    method : str
        "latin hypercube", "sobol" or "random".
    keys : int
        Dimensions of the cube [-].
    samples : int
        Number of points [-].
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Array
        Points, shape (samples, keys) [-].
    """
    from scipy.stats import qmc

    rng = np.random.default_rng(seed)
    if method == "random":
        return rng.random((samples, keys))
    if method == "sobol":
        return qmc.Sobol(keys, seed=rng).random(samples)
    return qmc.LatinHypercube(keys, seed=rng).random(samples)


def saltelli_design(keys: int, samples: int, seed: int) -> Array:
    """Points for Sobol indices: A, B, and for each key A with its column from B.

    Saltelli et al. (2010).

    Parameters
    ----------
    keys : int
        Number of keys [-].
    samples : int
        Rows of A and of B, a power of 2 [-].
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Array
        Points of the unit cube, shape (samples (keys + 2), keys) [-].
    """
    both = unit_sample("sobol", 2 * keys, samples, seed)
    first, second = both[:, :keys], both[:, keys:]
    mixed = []
    for key in range(keys):
        one = first.copy()
        one[:, key] = second[:, key]
        mixed.append(one)
    return np.concatenate([first, second, *mixed])


def morris_design(keys: int, trajectories: int, levels: int, seed: int) -> Array:
    """Trajectories in which one key after the other moves by p/(2(p - 1)), Morris (1991).

    Parameters
    ----------
    keys : int
        Number of keys [-].
    trajectories : int
        Number of trajectories [-].
    levels : int
        Levels p of each key, an even number [-].
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Array
        Points of the unit cube, shape (trajectories (keys + 1), keys) [-].
    """
    rng = np.random.default_rng(seed)
    step = levels / (2.0 * (levels - 1.0))
    lower = np.arange(levels // 2) / (levels - 1.0)
    rows = []
    for _ in range(trajectories):
        place = rng.choice(lower, keys)
        up = rng.random(keys) < 0.5
        place = np.where(up, place, place + step)
        rows.append(place.copy())
        for key in rng.permutation(keys):
            place[key] += step if up[key] else -step
            rows.append(place.copy())
    return np.array(rows)


def _correlations(
    options: SampleOptions, keys: Sequence[str], where: KeyPath
) -> tuple[Array, list[CaseProblem]]:
    """The correlation matrix of normal scores, and what is wrong with it."""
    matrix = np.eye(len(keys))
    place = (*where, "correlations")
    allowed = "allowed: lists of two keys of this block and a number above -1 and below 1"
    for entry in options.correlations:
        right = isinstance(entry, list | tuple) and len(entry) == 3
        if not right or entry[0] == entry[1] or not {*entry[:2]} <= {*keys}:
            return matrix, [CaseProblem(place, f"found {shown(entry)}", allowed)]
        number = entry[2]
        if isinstance(number, bool | str) or not -1.0 < number < 1.0:
            return matrix, [CaseProblem(place, f"found {shown(entry)}", allowed)]
        i, j = keys.index(entry[0]), keys.index(entry[1])
        matrix[i, j] = matrix[j, i] = number
    if options.correlations and np.linalg.eigvalsh(matrix).min() <= 0.0:
        finding = "no distribution has all of these correlations at once"
        return matrix, [CaseProblem(place, finding, "allowed: a positive definite matrix of them")]
    return matrix, []
