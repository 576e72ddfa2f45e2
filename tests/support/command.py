"""The command line for tests, within this process."""

from sweep.__main__ import main


def crumple(capsys, *arguments):
    """Exit status, stdout and stderr of a call."""
    try:
        status = main(arguments)
    except SystemExit as stop:
        status = stop.code
    return status, *capsys.readouterr()
