"""Tables, Markdown and pictures of results; the only matplotlib."""
