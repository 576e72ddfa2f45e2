"""Draw all figures into a folder: `python -m tests.studies.course_report results/figures`."""

import sys
import time
from pathlib import Path

from tests.studies.course_report import (
    cycles,
    damping,
    energies,
    frames,
    projection,
    sensitivity,
    springs,
    strain,
    stretching,
)

HEADS = ("The report", "Here", "Where they differ, and why")
FIGURES = {
    "fig03_springs": springs.draw,
    "fig05_fig06_frames": frames.draw,
    "fig07_strain": strain.draw,
    "fig08_energies": energies.draw,
    "fig09_fig10_stretching": stretching.draw,
    "damping": damping.draw,
    "contact_models": projection.draw,
    "cycles": cycles.draw,
    "sensitivity": sensitivity.draw,
}


def caption(path, parts):
    """Write a caption."""
    text = "\n\n".join(f"**{head}.** {part}" for head, part in zip(HEADS, parts, strict=True))
    path.write_text(f"{text}\n", encoding="utf-8")


def main(folder):
    """Draw every figure and write its caption."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        started = time.monotonic()
        sys.stdout.write(f"{folder / name}.md  ")
        sys.stdout.flush()  # a case that does not converge ends the program
        caption(folder / f"{name}.md", draw(folder))
        sys.stdout.write(f"{time.monotonic() - started:.0f} s\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
