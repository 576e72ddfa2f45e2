"""The program of a page in a document that stands in for a browser's."""

import json
from contextlib import contextmanager
from html.parser import HTMLParser
from pathlib import Path

from py_mini_racer import MiniRacer

VOID = ("meta", "input", "br", "link")  # elements without an end


class _Tree(HTMLParser):
    """The elements of a page, each as its name, its attributes and its children."""

    def __init__(self, text):
        super().__init__()
        self.root = ["root", {}, []]
        self._open = [self.root]
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        element = [tag, dict(attrs), []]
        self._open[-1][2].append(element)
        if tag not in VOID:
            self._open.append(element)

    def handle_endtag(self, tag):
        while self._open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        self._open[-1][2].append(data)


@contextmanager
def opened(page):
    """A function that evaluates a script in this page (HTML), whose program has run."""
    *_, program = page.split("<script>")
    tree = json.dumps(_Tree(page).root)
    with MiniRacer() as engine:
        engine.eval(Path(__file__).with_suffix(".js").read_text("utf-8"))
        engine.eval(f"document.root = built({tree})")
        engine.eval(program.partition("</script>")[0])

        def run(script):
            return json.loads(engine.eval(f"JSON.stringify({script}) ?? 'null'"))

        yield run
