"""Published crushes, and those of users: predictions that are stored before the measured values."""
