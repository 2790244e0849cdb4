"""Edges of a rectangle mesh; nodes have the numbers i ny + j."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..arrays import Array


@dataclass(frozen=True, slots=True)
class Edges:
    """All edges of one direction, from `tail` to `head`; matrices between edges and nodes.

    With linear functions along an edge and the trapezoidal rule across, the integral of F times
    grad phi is `balance` @ F, F the component of the flux along the edges.
    """

    tail: NDArray[np.int_]  # shape (edges,)
    head: NDArray[np.int_]
    length: Array  # shape (edges,) [-]
    balance: sparse.csr_matrix  # shape (nodes, edges): + width at the head, - width at the tail
    slope: sparse.csr_matrix  # shape (edges, nodes): differences over the length
    mean: sparse.csr_matrix  # shape (edges, nodes)
    # shape (nodes, edges): mean of the edges before and behind a node by their lengths, which is
    # the projection of their slopes with lumped mass
    projection: sparse.csr_matrix


def edges(x: Array, y: Array) -> tuple[Edges, Edges]:
    """Edges along x and along y of a rectangle mesh.

    Parameters
    ----------
    x : Array
        lines of nodes along x, shape (nx,) [-]
    y : Array
        lines of nodes along y, shape (ny,) [-]

    Returns
    -------
    along_x
        edges along x
    along_y
        edges along y
    """
    number = np.arange(len(x) * len(y)).reshape(len(x), len(y))
    return _edges(number, x, y), _edges(number.T, y, x)


def dual_lengths(lines: Array) -> Array:
    """Integral of the hat function of each line.

    Parameters
    ----------
    lines : Array
        positions of the lines, shape (lines,) [-]

    Returns
    -------
    Array
        integrals, shape (lines,) [-]
    """
    return np.convolve(np.diff(lines), (0.5, 0.5))


def _edges(number: NDArray[np.int_], along: Array, across: Array) -> Edges:
    """Edges along the first axis of the nodes' numbers."""
    shape = (len(along) - 1, len(across))
    tail = number[:-1].ravel()
    head = number[1:].ravel()
    length = np.broadcast_to(np.diff(along)[:, None], shape).ravel()
    width = np.broadcast_to(dual_lengths(across), shape).ravel()
    ends = (head, tail)
    nearby = at_ends(ends, (length, length), number.size).T
    inverse = sparse.diags(1.0 / np.asarray(nearby.sum(axis=1)).ravel())
    half = np.full(len(tail), 0.5)
    return Edges(
        tail=tail,
        head=head,
        length=length,
        balance=at_ends(ends, (width, -width), number.size).T.tocsr(),
        slope=at_ends(ends, (1.0 / length, -1.0 / length), number.size),
        mean=at_ends(ends, (half, half), number.size),
        projection=(inverse @ nearby).tocsr(),
    )


def at_ends(
    ends: tuple[NDArray[np.int_], NDArray[np.int_]], values: tuple[Array, Array], nodes: int
) -> sparse.csr_matrix:
    """Matrix with a value at each of both ends of every edge.

    Parameters
    ----------
    ends : tuple[NDArray[np.int_], NDArray[np.int_]]
        numbers of the nodes at both ends, shape (edges,) each
    values : tuple[Array, Array]
        values at both ends, shape (edges,) each [any unit]
    nodes : int
        number of nodes

    Returns
    -------
    sparse.csr_matrix
        matrix, shape (edges, nodes) [unit of `values`]
    """
    edge = np.arange(len(ends[0]))
    entries = (np.concatenate(values), (np.concatenate((edge, edge)), np.concatenate(ends)))
    return sparse.csr_matrix(entries, shape=(len(edge), nodes))
