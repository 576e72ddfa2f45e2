"""Tables as HTML: nothing of a text is markup; pictures stand in front."""

from sweep.report.tables.html import html_table
from sweep.report.tables.sheet import Sheet

SHEET = Sheet("a < b", ["#", "x&y"], [["1", "<b>"], ["2", '"']], notes=("c > d",))


def test_texts_are_escaped():
    text = html_table(SHEET)
    assert "<h3>a &lt; b</h3>" in text
    assert "<td>&lt;b&gt;</td>" in text
    assert '<p class="quiet">c &gt; d</p>' in text
    assert text.count("<td>") == 4


def test_pictures_are_those_of_the_cases():
    text = html_table(SHEET._replace(cases=("aa", "bb")), {"bb": "<svg/>"})
    assert "<tr><td></td><td>1</td>" in text
    assert "<tr><td><svg/></td><td>2</td>" in text
    assert "<thead><tr><th></th><th" in text
    assert "<th></th>" not in html_table(SHEET._replace(cases=("aa", "bb")), {"cc": "<svg/>"})


def test_a_sheet_without_a_table_has_its_notes():
    assert html_table(Sheet("", [], [], notes=("none",))) == '<p class="quiet">none</p>'
