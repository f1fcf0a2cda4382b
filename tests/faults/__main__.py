"""Run the campaigns: `python -m faults` in the folder tests; `make test-faults` does."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from faults.mutations import mutate_journals, mutate_models, mutate_results, mutate_studies
from faults.runs import fill, kill

CAMPAIGNS = {
    "kills": (kill, 100),
    "disks": (fill, 50),
    "results": (mutate_results, 1000),
    "journals": (mutate_journals, 500),
    "studies": (mutate_studies, 300),
    "models": (mutate_models, 300),
}


def main() -> int:
    """Run the campaigns asked for and print what they counted; 1 if anything happened that must not."""
    parser = argparse.ArgumentParser(prog="faults", description=__doc__)
    parser.add_argument("campaigns", nargs="*", choices=[*CAMPAIGNS, []], help="default: all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--part", type=float, default=1.0, help="of the trials (default: 1)")
    given = parser.parse_args()
    bad = 0
    for name in given.campaigns or CAMPAIGNS:
        campaign, trials = CAMPAIGNS[name]
        with tempfile.TemporaryDirectory() as folder:
            count = campaign(max(1, round(given.part * trials)), given.seed, Path(folder).resolve())
        print(count, flush=True)
        bad += len(count.faults)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
