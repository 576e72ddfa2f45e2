"""A Dask scheduler and its workers as processes of this machine, to be killed."""

import json
import os
import subprocess
import sys
import time
from contextlib import AbstractContextManager
from pathlib import Path

ROOT = Path(__file__).parents[2]
LATEST = 60.0  # seconds


class Processes(AbstractContextManager):
    """A scheduler and workers, which end with the block; `folder` is for their files.

    source: the folder from which they import Crumple.
    """

    def __init__(self, folder, source=ROOT):
        self.folder, self.source = Path(folder), source
        self.file = self.folder / "scheduler.json"
        self.scheduler, self.workers = None, []

    def __enter__(self):
        self.start_scheduler()
        return self

    def __exit__(self, *_):
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()

    @property
    def address(self):
        """Address of the scheduler."""
        return json.loads(self.file.read_text())["address"]

    def start_scheduler(self, port=0):
        """Start the scheduler, and wait until it has written its file."""
        self.file.unlink(missing_ok=True)
        words = ["scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"]
        self.scheduler = self._start(*words, "--scheduler-file", str(self.file))
        limit = time.monotonic() + LATEST
        while not (self.file.exists() and self.file.read_text().endswith("}")):
            assert time.monotonic() < limit
            time.sleep(0.02)

    def add(self, count=1, source=None, name=None):
        """Start workers of one thread, without a nanny; return their processes."""
        words = ["worker", self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
        words += ["--local-directory", str(self.folder)]
        words += ["--name", name] if name else []
        new = [self._start(*words, source=source) for _ in range(count)]
        self.workers += new
        return new

    def _start(self, *words, source=None):
        command = [sys.executable, "-m", "dask", *words]
        places = os.environ | {"PYTHONPATH": str(source or self.source)}
        quiet = subprocess.DEVNULL
        return subprocess.Popen(command, cwd=self.folder, env=places, stdout=quiet, stderr=quiet)
