"""The command line: its verbs, and the output on the terminal."""
