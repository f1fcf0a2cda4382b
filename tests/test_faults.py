"""A tenth of the campaigns of faults; `make test-faults` runs them whole."""

from pathlib import Path

import pytest
from faults.__main__ import CAMPAIGNS


@pytest.mark.parametrize("name", CAMPAIGNS)
def test_nothing_is_lost_and_nothing_wrong_is_read(name: str, tmp_path: Path) -> None:
    campaign, trials = CAMPAIGNS[name]
    count = campaign(trials // 10, 1, tmp_path)
    assert sum(count.ends.values()) == trials // 10
    assert not count.faults, str(count)
