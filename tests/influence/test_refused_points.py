"""Points whose sensitivities are refused, with what to give instead."""

from dataclasses import replace

import pytest
from problems.fields import branch_of_cusp

import mjcont as mc


@pytest.mark.parametrize("verb", [mc.sensitivities, lambda p: mc.continue_special(p, "m_1"), mc.switch_branches])
def test_what_is_no_point_is_refused_with_what_to_write(verb):
    with pytest.raises(mc.ParameterError, match=r'got the str .LP1.: take one of a branch: branch.point\("[BL]P1"\)'):
        verb("LP1")


def test_kinds_without_a_regular_system_are_refused_with_the_valid_ones():
    other = replace(branch_of_cusp().special_points[0], kind="GH", label="GH1")
    with pytest.raises(mc.MjcontError, match="Valid kinds: LP, HB"):
        mc.sensitivities(other)
