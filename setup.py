"""Lays out a wheel: all in one package, as other projects use the names `kernels` and `sweep` too.

    crumple/__init__.py                               crumple.py
    crumple/kernels/, crumple/sweep/                  these folders; what they import of each other,
                                                      they import from `crumple.kernels` and so on
    crumple/configs/                                  this folder: materials and examples

An editable install takes the checkout as it is. Everything else is in pyproject.toml, except what
depends on the address of the repository, PROJECT_URL, which a release sets.
"""

import os
import re
import shutil
import tomllib
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.egg_info import egg_info

ROOT = Path(__file__).parent
OWN_IMPORT = re.compile(r"^( *from )(?=(?:kernels|sweep)\b)", re.MULTILINE)
RELATIVE = re.compile(r"(!?)(\[[^\]]*\]\()(?![a-z]+:|#)")  # a link or a picture in Markdown
MAIN = '''"""The command line, as `python -m crumple`."""

from crumple import main

raise SystemExit(main())
'''


class OnePackage(build_py):
    """Copies the modules, then moves them into one package."""

    def run(self):
        """Build; an editable install needs no copy."""
        if self.editable_mode:
            super().run()
            return
        built = Path(self.build_lib)
        shutil.rmtree(built, ignore_errors=True)  # it may hold modules of an earlier build
        super().run()
        move(built, built / "crumple")


def move(built, package):
    """Move the built modules into a package, and add the files that are no modules of the
    checkout.
    """
    package.mkdir()
    (built / "crumple.py").rename(package / "__init__.py")
    for folder in ("kernels", "sweep"):
        (built / folder).rename(package / folder)
    for path in package.rglob("*.py"):
        path.write_text(OWN_IMPORT.sub(r"\1crumple.", path.read_text("utf-8")), "utf-8")
    (package / "__main__.py").write_text(MAIN, "utf-8")
    (package / "py.typed").touch()
    shutil.copytree(ROOT / "configs", package / "configs")


class OneName(egg_info):
    """Writes the metadata of the project, with the one top-level name of a wheel."""

    def run(self):
        """Write the metadata."""
        super().run()
        Path(self.egg_info, "top_level.txt").write_text("crumple\n", "utf-8")


def about(url):
    """The README and links of the project; with an address, links of the README lead there."""
    readme = (ROOT / "README.md").read_text("utf-8")
    pages = {}
    if url:
        tag = (
            "v" + tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["version"]
        )
        folder = {"!": f"{url}/raw/{tag}/", "": f"{url}/blob/{tag}/"}
        readme = RELATIVE.sub(lambda link: link[0] + folder[link[1]], readme)
        pages = {"Source": url, "Issues": f"{url}/issues", "Changelog": folder[""] + "CHANGELOG.md"}
    return {
        "long_description": readme,
        "long_description_content_type": "text/markdown",
        "project_urls": pages,
    }


if __name__ == "__main__":
    own = {"build_py": OnePackage, "egg_info": OneName}
    setup(cmdclass=own, **about(os.environ.get("PROJECT_URL", "")))
