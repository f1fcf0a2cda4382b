"""The command line as a program: `mjcont`, or `python -m mjcont`. An interrupt while modules load is one line, too."""

import sys


def main() -> int:
    """Run the command line and return its exit status."""
    try:
        from mjcont.commands.cli import main as run

        return run()
    except KeyboardInterrupt:
        print("mjcont: interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
