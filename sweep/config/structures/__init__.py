"""Custom structures: the JSON file, what it may hold, and which motions it must not leave free."""
