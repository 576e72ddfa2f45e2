"""Samples of several sides, measured in turn, so that a noisy moment meets all of them alike."""

import time

import numpy as np


def seconds(action):
    """CPU seconds of all threads that a call takes."""
    started = time.process_time()
    action()
    return time.process_time() - started


def medians(sides, count):
    """Median over ``count`` rounds of every side, a function that returns its measurement."""
    samples = [{name: measure() for name, measure in sides.items()} for _ in range(count)]
    return {name: float(np.median([sample[name] for sample in samples])) for name in sides}
