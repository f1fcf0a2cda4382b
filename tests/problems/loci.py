"""Loci that several files of tests follow."""

from __future__ import annotations

from functools import cache

import mjcont as mc
from problems.fields import branch_of_ab


def kinds(branch):
    return [p.kind for p in branch.special_points]


def only(branch, kind):
    (point,) = branch.of_kind(kind)
    return point


@cache
def folds_of_ab(label="LP1"):
    return mc.continue_special(branch_of_ab(18.0).point(label), "B", bounds=(8.0, 40.0))


@cache
def hopfs_of_ab(label="HB2", high=24.0, **options):
    return mc.continue_special(branch_of_ab(18.0).point(label), "B", bounds=(8.0, high), **options)
