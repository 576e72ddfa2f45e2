"""Tables, Markdown and pictures of results. The only user of matplotlib."""
