"""Sweeps of many cases with invented results: time and memory of every verb (`make scale`)."""
