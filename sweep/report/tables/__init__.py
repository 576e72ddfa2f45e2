"""Tables as text: rankings (`sheets`), accuracy, materials, searches; Markdown of any of them."""
