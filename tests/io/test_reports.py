import json
import re
from base64 import b64decode
from datetime import datetime
from html.parser import HTMLParser
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import seiswidgets as sw
from seiswidgets.io.exports.reports import _plain
from tests.io.restored import NAUGHTY, restored


def test_json_holds_the_numbers_of_the_reports(tmp_path):
    sw.save_report(restored(True), tmp_path / "report.json")
    found = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert found["section"]["name"] == NAUGHTY
    assert found["section"]["shape"] == list(restored(True).original.shape)
    for stage, made in zip(found["stages"], restored(True).stages, strict=True):
        report = made.report
        assert (stage["kind"], stage["picks"]) == (report.kind, list(report.picks))
        assert stage["energy"] == report.energy
        assert stage["area_ratio"] == {str(percent): value for percent, value in report.area_ratio.items()}
        assert [cutoff["throw"] for cutoff in stage["cutoffs"]] == [cutoff.throw for cutoff in report.cutoffs]
        assert [bed["flatness"] for bed in stage["beds"]] == [bed.flatness for bed in report.beds]


def test_what_is_not_finite_is_none_in_json():
    assert _plain({1: (np.nan, np.float64("inf"), 2.5)}) == {"1": [None, None, 2.5]}


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.tags, self.text = set(), ""

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)

    def handle_data(self, data):
        self.text += data


def test_names_are_text_in_a_page(tmp_path):
    sw.save_report(restored(True), tmp_path / "report.html")
    page = Tags()
    page.feed((tmp_path / "report.html").read_text("utf-8"))
    tables = {"table", "tr", "th", "td", "details", "summary"}
    assert page.tags - tables <= {"html", "meta", "title", "style", "h1", "h2", "p", "img"}
    assert f"unfault {NAUGHTY}" in page.text
    assert "data: '<b>us</b>'" in page.text


def test_a_page_has_the_figure_the_weights_the_hold_the_date_and_the_version(tmp_path):
    case = sw.synthetic.planar_fault()
    plan = sw.Plan((sw.Step("unfault"),), sw.Weights(stitch=33.0), spacing=200.0, fixed=(450.0, 500.0))
    sw.save_report(plan.restore(case.section, case.interpretation), tmp_path / "report.html", case.interpretation)
    text = (tmp_path / "report.html").read_text("utf-8")
    image = re.search(r'src="data:image/png;base64,([^"]+)"', text)
    assert Image.open(BytesIO(b64decode(image[1]))).width > 1000
    assert "stitch 33, flatten 10" in text
    assert "Held: the block at x=450 m, z=500 m." in text
    assert f"seiswidgets {sw.__version__}" in text
    assert f"{datetime.now():%d %B %Y}" in text
    sw.save_report(plan.restore(case.section, case.interpretation), tmp_path / "report.json")
    found = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert (found["stages"][0]["fixed"], found["stages"][0]["weights"]["stitch"]) == ([450.0, 500.0], 33.0)
    assert datetime.fromisoformat(found["written"]).tzinfo is not None


def test_nothing_restored_is_said(tmp_path):
    sw.save_report(sw.Restoration(restored().original), tmp_path / "report.html")
    assert "Nothing has been restored yet" in (tmp_path / "report.html").read_text("utf-8")


def test_another_ending_is_refused(tmp_path):
    with pytest.raises(sw.SettingError, match=r"report.pdf must end in .json or .html"):
        sw.save_report(restored(), tmp_path / "report.pdf")
