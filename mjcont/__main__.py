"""`python -m mjcont`: the command line."""

import sys

from mjcont.commands.cli import main

if __name__ == "__main__":
    sys.exit(main())
