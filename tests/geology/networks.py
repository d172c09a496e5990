"""Two faults that cross: the younger one offsets the older one. All blocks are rigid, so the restoration is known."""

from dataclasses import dataclass

import numpy as np

import seiswidgets as sw

WIDTH, DEPTH = 6000.0, 2400.0
SECTION = sw.Section(np.zeros((241, 121), np.float32), 50.0, 10.0)


@dataclass(frozen=True)
class Slip:
    """Rigid slip of a hanging wall down dip (or up, if negative) along a straight fault."""

    x: float  # of the fault at the section's top
    dip: float  # degrees to the right; above 90 to the left
    slip: float

    @property
    def direction(self):
        return np.array([np.cos(np.radians(self.dip)), np.sin(np.radians(self.dip))])

    def hangs(self, points):
        """True for points in the hanging wall."""
        along = self.direction
        right = (points - [self.x, 0]) @ [along[1], -along[0]] > 0
        return right == (along[0] > 0)

    def at(self, z):
        return np.array([self.x + z * self.direction[0] / self.direction[1], z])

    def undo(self, points):
        return points - np.outer(self.hangs(points), self.slip * self.direction)


@dataclass(frozen=True)
class Crossing:
    """An older and a younger fault, and level beds at some depths that both have offset."""

    older: Slip
    younger: Slip
    depths: tuple[float, ...]

    def truth(self, points):
        return self.older.undo(self.younger.undo(np.array(points, float)))

    @property
    def parts(self):
        """Ends of the older fault's upper and lower part, as the younger one has offset them."""
        one, other = self.older.direction, self.younger.direction
        start = self.younger.at(0) - self.older.at(0)
        crossing = self.older.at(0) + np.linalg.solve(np.column_stack([one, -other]), start)[0] * one
        offset = crossing + self.younger.slip * other
        upper, lower = (offset if self.younger.hangs(crossing + step) else crossing for step in (-one, one))
        return np.array([upper - one * upper[1] / one[1], upper]), np.array(
            [lower, lower + one * (DEPTH - lower[1]) / one[1]]
        )

    @property
    def horizons(self):
        return [self._horizon(f"H{index}", z) for index, z in enumerate(self.depths, 1)]

    def _horizon(self, name, z):
        pieces = []
        bed = np.column_stack([np.linspace(-1000, WIDTH + 1000, 20_001), np.full(20_001, z)])
        for sunk, moved in np.ndindex(2, 2):
            part = bed[self.older.hangs(bed) == bool(sunk)] + sunk * self.older.slip * self.older.direction
            part = part[self.younger.hangs(part) == bool(moved)] + moved * self.younger.slip * self.younger.direction
            part = part[((part >= 0) & (part <= (WIDTH, DEPTH))).all(axis=1)]
            if len(part) > 100:
                pieces.append(part[[0, -1]])
        return sw.Horizon(*pieces, name=name)

    @property
    def fixed(self):
        """A point of the block that has moved least."""
        points = np.random.default_rng(0).uniform((200, 200), (WIDTH - 200, DEPTH - 200), (1000, 2))
        return tuple(points[np.argmin(np.abs(self.truth(points) - points).sum(axis=1))])

    def errors(self, restoration):
        """Distance of random points from where they belong, in metres."""
        points = np.random.default_rng(1).uniform((0, 0), (WIDTH, DEPTH), (2000, 2))
        truth = self.truth(points) - (self.truth(held := np.array([self.fixed])) - held)
        apart = np.hypot(*(restoration.to_restored(points) - truth).T)
        return apart[np.isfinite(apart)]
