"""Damaged files and killed runs: nothing is silently wrong or lost (`make torture`)."""
