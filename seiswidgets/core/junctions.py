"""Junctions of faults: what the side of a fault slides onto beyond the fault's end."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

FACING = -np.sqrt(0.5)  # cosine between outward normals: sides that face each other, to within 45 degrees


@dataclass(frozen=True, eq=False)
class SideAtJunction:
    """One side of a fault, from a junction onwards.

    Attributes
    ----------
    fault, side : int
    corner, opposite : int
        Vertex of the cut mesh at the junction, on this side and on the opposite one; two sides that share a corner
        bound the same rock.
    outward : array, shape (2,)
        Unit normal at the junction, out of the rock.
    segments : array, shape (k, 2)
        Its edges in the cut mesh, directed as the fault.
    """

    fault: int
    side: int
    corner: int
    opposite: int
    outward: np.ndarray
    segments: np.ndarray

    def faces(self, other: "SideAtJunction") -> bool:
        """True if rock on this side can slide onto the other side of another fault."""
        apart = self.fault != other.fault and self.corner != other.corner
        return bool(apart and self.outward @ other.outward < FACING)


@dataclass(frozen=True, eq=False)
class Continuation:
    """The sides of other faults that continue the opposite side of a fault beyond its ends.

    Attributes
    ----------
    segments : array, shape (k, 2)
        Edges in the cut mesh, directed as the opposite side.
    corners : tuple of int
        The vertices at which the opposite side ends.
    """

    segments: np.ndarray
    corners: tuple[int, ...]


NOTHING = Continuation(np.empty((0, 2), int), ())


def continuations(
    vertices: np.ndarray, edges: Sequence[np.ndarray], sides: Sequence[np.ndarray]
) -> list[tuple[Continuation, Continuation]]:
    """The sides of other faults that each side of each fault may slide onto, where faults meet.

    Rock that slides down a thrust's ramp reaches the floor that the ramp branches off. The ramp ends there, so contact
    with its own footwall does not hold the rock any longer; contact with the floor does.

    Parameters
    ----------
    vertices : array, shape (n, 2)
        Of the mesh before it is cut.
    edges : list of array, shape (s, 2)
        Directed edges of each fault in that mesh, in order.
    sides : list of array, shape (2, s, 2)
        Both copies of them in the cut mesh.

    Returns
    -------
    list of (Continuation, Continuation)
        For points on the first and on the second side of each fault.
    """
    found = [[NOTHING, NOTHING] for _ in edges]
    for junction in _junctions(edges):
        around = _sides_at(junction, vertices, edges, sides)
        for one in around:
            for other in around:
                if one.faces(other):
                    segments = other.segments if other.side != one.side else other.segments[:, ::-1]
                    before = found[one.fault][one.side]
                    found[one.fault][one.side] = Continuation(
                        np.vstack([before.segments, segments]), (*before.corners, one.opposite)
                    )
    return [(first, second) for first, second in found]


def _junctions(edges: Sequence[np.ndarray]) -> list[int]:
    """Vertices where edges of several faults meet."""
    ends = np.concatenate([np.unique(along) for along in edges])
    used, counts = np.unique(ends, return_counts=True)
    junctions: list[int] = used[counts > 1].tolist()
    return junctions


def _sides_at(
    junction: int, vertices: np.ndarray, edges: Sequence[np.ndarray], sides: Sequence[np.ndarray]
) -> list[SideAtJunction]:
    around = []
    for fault, along in enumerate(edges):
        for index, end in np.argwhere(along == junction).tolist():
            onwards = slice(index, None) if end == 0 else slice(None, index + 1)
            x, z = np.subtract(*vertices[along[index, ::-1]])
            outward = np.array([z, -x]) / np.hypot(x, z)
            for side, out in ((0, outward), (1, -outward)):
                corner, opposite = sides[fault][[side, 1 - side], index, end].tolist()
                around.append(SideAtJunction(fault, side, corner, opposite, out, sides[fault][side, onwards]))
    return around
