"""Shared by all tests."""

import os

# Pictures are drawn into files: no test needs a screen, whatever the user's settings say.
os.environ["MPLBACKEND"] = "Agg"
