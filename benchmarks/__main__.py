"""`python -m benchmarks [-o FILE] [--repeats N] [--quick]`: one thread each, since threads cost more than they give."""

import os
import sys

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):  # read when numpy is imported
    os.environ.setdefault(name, "1")

if __name__ == "__main__":
    from benchmarks.run import main

    sys.exit(main())
