"""Runs beside a sweep, in files of their own: error bars, spreads of materials, first screens."""
