"""Numbers and lists as text."""

from math import ceil, floor, inf, log10


def value_with_error(value: float, error: float, most: int = 5) -> str:
    """Text of a value and its uncertainty, to the error's first digit (second after a 1), in
    whatever unit [-].

    With no more than `most` decimals [-]; an error that these cannot show is rounded up.
    """
    digits = 3
    if 0.0 < error < inf:
        exponent = floor(log10(error))
        wanted = max(-exponent + (error < 1.95 * 10.0**exponent), 0)
        digits = min(wanted, most)
        if wanted > most:
            error = ceil(error * 10.0**most) / 10.0**most
    return f"{value:.{digits}f} ± {error:.{digits}f}"


MANY = 8  # balls are listed one by one up to this number


def listed(words: list[str]) -> str:
    """Words side by side; the ends of a long list."""
    return ", ".join(words) if len(words) <= MANY else f"{', '.join(words[:2])} ... {words[-1]}"
