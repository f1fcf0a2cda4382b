"""A net of masses on springs, with its forces and stiffness in closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

GRAVITY = 9.81


@dataclass(frozen=True)
class Net:
    """A grid of masses a mesh width apart, joined to their neighbours and to a fixed border by equal springs.

    The force in a spring of length L is k (L - L0), its stiffness k [(1 - L0 / L) I + (L0 / L) u u'] along u.
    """

    rows: int
    columns: int
    width: float = 0.05
    mass: float = 0.01
    spring: float = 200.0
    rest: float = 0.04
    damper: float = 0.1
    string_damper: float = 0.02

    @property
    def places(self):
        """Where masses (rows, columns) and border stand, by their place in the grid."""
        every = [(i, j) for i in range(self.rows + 2) for j in range(self.columns + 2)]
        inner = [(i, j) for i, j in every if 0 < i <= self.rows and 0 < j <= self.columns]
        return inner, [p for p in every if p not in set(inner)]

    @property
    def strings(self):
        """Pairs of neighbours, one of which at least is a mass."""
        inner = set(self.places[0])
        pairs = [((i, j), beside) for i, j in inner for beside in ((i + 1, j), (i, j + 1), (i - 1, j), (i, j - 1))]
        return sorted({tuple(sorted(pair)) for pair in pairs})

    def xml(self, contact="disable"):
        inner, border = self.places

        def at(place):
            return f"{place[1] * self.width} {place[0] * self.width} 0"

        def site(place):
            return f"s{place[0]}_{place[1]}"

        fixed = "".join(f'<site name="{site(p)}" pos="{at(p)}"/>' for p in border)
        axes = ("1 0 0", "0 1 0", "0 0 1")
        slides = "".join(f'<joint type="slide" axis="{a}" damping="{self.damper}"/>' for a in axes)
        masses = "".join(
            f'<body pos="{at(p)}">{slides}<geom type="sphere" size="0.005" mass="{self.mass}"/>'
            f'<site name="{site(p)}"/></body>'
            for p in inner
        )
        strings = "".join(
            f'<spatial stiffness="{self.spring}" springlength="{self.rest}" damping="{self.string_damper}">'
            f'<site site="{site(a)}"/><site site="{site(b)}"/></spatial>'
            for a, b in self.strings
        )
        return (
            f'<mujoco model="net"><option gravity="0 0 -{GRAVITY}"><flag contact="{contact}"/></option>'
            f"<worldbody>{fixed}{masses}</worldbody><tendon>{strings}</tendon></mujoco>"
        )

    @property
    def weight(self):
        return self.rows * self.columns * self.mass * GRAVITY

    def _strung(self, x):
        """For every string: its ends among the masses, -1 at the border, and the vector along it."""
        inner, _ = self.places
        number = {p: k for k, p in enumerate(inner)}
        moved = np.asarray(x).reshape(-1, 3)

        def position(place):
            home = np.array([place[1] * self.width, place[0] * self.width, 0.0])
            return home + moved[number[place]] if place in number else home

        for a, b in self.strings:
            yield number.get(a, -1), number.get(b, -1), position(b) - position(a)

    def forces(self, x):
        """Forces on the masses, (3 masses,)."""
        out = np.zeros((self.rows * self.columns, 3))
        out[:, 2] = -self.mass * GRAVITY
        for a, b, along in self._strung(x):
            length = np.linalg.norm(along)
            pull = self.spring * (length - self.rest) * along / length
            for end, sign in ((a, 1.0), (b, -1.0)):
                if end >= 0:
                    out[end] += sign * pull
        return out.ravel()

    def _assembled(self, x, block):
        n = 3 * self.rows * self.columns
        out = np.zeros((n, n))
        for a, b, along in self._strung(x):
            length = np.linalg.norm(along)
            part = block(length, np.outer(along, along) / length**2)
            for i, j, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
                if i >= 0 and j >= 0:
                    out[3 * i : 3 * i + 3, 3 * j : 3 * j + 3] += sign * part
        return out

    def stiffness(self, x):
        """K, (3 masses, 3 masses)."""

        def block(length, along):
            share = self.rest / length
            return self.spring * ((1.0 - share) * np.eye(3) + share * along)

        return self._assembled(x, block)

    def dampers(self, x):
        """C, (3 masses, 3 masses)."""
        own = self.damper * np.eye(3 * self.rows * self.columns)
        return own + self._assembled(x, lambda length, along: self.string_damper * along)
