"""The command line: `arguments` says what each command takes, `cli` does it, `progress` prints while it goes."""
