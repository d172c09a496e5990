import csv
import json
import os
import time

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import seiswidgets as sw
from seiswidgets.errors import DataError, SettingError

DEPTH = sw.Section(np.ones((101, 201)), dx=10.0, dz=10.0)
TIME = sw.Section(np.ones((101, 201)), dx=10.0, dz=4.0, z_unit="ms", velocity=2000.0)
FORMATS = ["a.geojson", "a.csv"]


def picks(**named):
    """An interpretation of faults (a list of points) and horizons (lists of pieces), by name."""
    faults = [sw.Fault(lines[0], name=name) for name, lines in named.items() if name.startswith("F")]
    horizons = [sw.Horizon(*lines, name=name) for name, lines in named.items() if name.startswith("H")]
    return sw.Interpretation(faults, horizons)


def lines_of(interpretation):
    """All names and points of an interpretation, to compare."""
    faults = [(fault.name, [fault.points.tolist()]) for fault in interpretation.faults]
    return faults, [(h.name, [piece.tolist() for piece in h.pieces]) for h in interpretation.horizons]


def picks_named(name):
    return sw.Interpretation((sw.Fault([(900, 0), (1000, 1000)], name=name),), ())


SIMPLE = picks(F1=[[(900, 0), (1000, 1000)]], H1=[[(0, 100), (940, 120)], [(960, 300), (2000, 310)]])


def written(tmp_path, name, text):
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


places = st.floats(-1e6, 1e6)


@st.composite
def lines(draw):
    x = sorted(draw(st.lists(places, min_size=2, max_size=6, unique=True)))
    return [(value, draw(places)) for value in x]


@st.composite
def interpretations(draw):
    names = draw(st.lists(st.text(max_size=12), max_size=4, unique=True))
    faults = [sw.Fault(draw(lines()), name=name) for name in names]
    horizons = [sw.Horizon(*draw(st.lists(lines(), min_size=1, max_size=3)), name=name) for name in names]
    return sw.Interpretation(faults, horizons)


@pytest.mark.parametrize("name", FORMATS)
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(interpretation=interpretations())
def test_every_name_and_number_comes_back(tmp_path, name, interpretation):
    sw.write_picks(interpretation, tmp_path / name, DEPTH)
    assert lines_of(sw.read_picks(tmp_path / name, DEPTH)) == lines_of(interpretation)


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize(("use", "ends"), [("carry", "auto"), ("constrain", ("tip", "extend")), ("ignore", "tip")])
def test_uses_and_ends_come_back(tmp_path, name, use, ends):
    fault = sw.Fault([(900, 0), (1000, 1000)], "F1", ends=ends, use=use)
    horizon = sw.Horizon([(0, 100), (940, 120)], name="H1", use=use)
    sw.write_picks(sw.Interpretation((fault,), (horizon,)), tmp_path / name, DEPTH)
    again = sw.read_picks(tmp_path / name, DEPTH)
    assert (again.faults[0].use, again.faults[0].ends, again.horizons[0].use) == (use, fault.ends, use)
    text = (tmp_path / name).read_text().replace(use if use != "constrain" else "tip extend", "wrong")
    with pytest.raises(DataError, match=r"F1|wrong"):
        sw.read_picks(written(tmp_path, name, text), DEPTH)


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("kind", ["salt", "no data"])
def test_bodies_come_back(tmp_path, name, kind):
    bodies = (sw.Body([(100, 100), (300, 150), (200, 400)], kind, "B1"), sw.Body([(0, 1), (5, 1), (5, 9)], name="B2"))
    sw.write_picks(sw.Interpretation(SIMPLE.faults, (), bodies), tmp_path / name, DEPTH)
    again = sw.read_picks(tmp_path / name, DEPTH).bodies
    assert [(body.name, body.kind, body.points.tolist()) for body in again] == [
        (body.name, body.kind, body.points.tolist()) for body in bodies
    ]


def test_geojson_keeps_the_use_of_picks(tmp_path):
    carried = sw.Interpretation(SIMPLE.faults, [sw.Horizon(*SIMPLE.horizons[0].pieces, name="H1", use="carry")])
    sw.write_picks(carried, tmp_path / "a.geojson", DEPTH)
    read = sw.read_picks(tmp_path / "a.geojson", DEPTH)
    assert [pick.use for pick in (*read.faults, *read.horizons)] == ["constrain", "carry"]
    text = (tmp_path / "a.geojson").read_text().replace('"carry"', '"cut"')
    with pytest.raises(DataError, match=r"properties.use must be one of constrain, carry, ignore, but is 'cut'"):
        sw.read_picks(written(tmp_path, "b.geojson", text), DEPTH)


def test_geojson_is_what_other_programs_read(tmp_path):
    sw.write_picks(SIMPLE, tmp_path / "a.geojson", TIME)
    document = json.loads((tmp_path / "a.geojson").read_text())
    assert document["type"] == "FeatureCollection"
    assert document["seiswidgets_picks"] == {"version": 1, "x_unit": "m", "z_unit": "ms"}
    fault, horizon = document["features"]
    assert fault["geometry"] == {"type": "LineString", "coordinates": [[900.0, 0.0], [1000.0, 1000.0]]}
    assert horizon["geometry"]["type"] == "MultiLineString"
    assert horizon["properties"] == {"kind": "horizon", "name": "H1"}
    assert len(horizon["geometry"]["coordinates"]) == 2


def test_csv_is_a_row_a_point(tmp_path):
    sw.write_picks(SIMPLE, tmp_path / "a.csv", TIME)
    rows = (tmp_path / "a.csv").read_text().splitlines()
    assert rows[0] == "kind,name,piece,x (m),z (ms)"
    assert rows[1] == "fault,F1,1,900.0,0.0"
    assert rows[-1] == "horizon,H1,2,2000.0,310.0"
    assert len(rows) == 1 + 2 + 4


def test_csv_may_have_its_columns_in_any_order_and_more_of_them(tmp_path):
    text = "remark, Z (ms) ,name,kind,X,piece\nold,10,F1,fault,1,a\nold,20,F1,fault,2,a\n"
    (fault,) = sw.read_picks(written(tmp_path, "a.csv", text), TIME, x_unit="m").faults
    np.testing.assert_array_equal(fault.points, [(1, 10), (2, 20)])


@pytest.mark.parametrize("name", FORMATS)
def test_picks_come_in_the_units_of_the_section(tmp_path, name):
    sw.write_picks(SIMPLE, tmp_path / name, TIME)
    seconds = sw.Section(TIME.amplitude, dx=0.01, dz=0.004, x_unit="km", z_unit="s", velocity=2000.0)
    (fault,) = sw.read_picks(tmp_path / name, seconds).faults
    np.testing.assert_allclose(fault.points, [(0.9, 0), (1, 1)], rtol=1e-15)
    with pytest.raises(DataError, match=r"in two-way time \(ms\) and the section in depth \(m\)"):
        sw.read_picks(tmp_path / name, DEPTH)
    with pytest.raises(DataError, match="states z_unit 'ms', but z_unit='s' is given"):
        sw.read_picks(tmp_path / name, TIME, z_unit="s")


def test_z_that_grows_upwards_is_not_taken_for_depth(tmp_path):
    path = written(tmp_path, "a.cps3", "->\n5 0 -10\n6 0 -20\n")
    choices = {"format": "cps3-faults", "x_unit": "m", "z_unit": "m", "along": "x"}
    with pytest.raises(DataError, match=r"all z are negative.*z_up=True"):
        sw.read_picks(path, DEPTH, **choices)
    (fault,) = sw.read_picks(path, DEPTH, z_up=True, **choices).faults
    np.testing.assert_array_equal(fault.points, [(5, 10), (6, 20)])


@pytest.mark.parametrize(
    "edit",
    [
        {},
        {"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}, "name": "picks"},
        {"swap": True},
        {"extra": [0.0]},
        {"extra": [None], "swap": True},
    ],
)
def test_geojson_edited_in_a_gis_is_read_if_its_units_are_given(tmp_path, edit):
    sw.write_picks(SIMPLE, tmp_path / "a.geojson", TIME)
    document = json.loads((tmp_path / "a.geojson").read_text())
    del document["seiswidgets_picks"]
    document |= {name: value for name, value in edit.items() if name in ("crs", "name")}
    for number, feature in enumerate(document["features"]):
        feature["properties"]["fid"] = number
        geometry = feature["geometry"]
        if geometry["type"] == "LineString":
            geometry["coordinates"] = [geometry["coordinates"]]
        pieces = [[[*point, *edit.get("extra", [])] for point in piece] for piece in geometry["coordinates"]]
        geometry |= {"type": "MultiLineString", "coordinates": pieces}
        if not edit.get("swap") and len(pieces) == 1:
            geometry |= {"type": "LineString", "coordinates": pieces[0]}
    document["features"].append({"type": "Feature", "properties": {"kind": None, "name": None}, "geometry": None})
    path = written(tmp_path, "a.geojson", json.dumps(document))
    with pytest.warns(UserWarning, match="left out 1 feature without a geometry"):
        read = sw.read_picks(path, TIME, x_unit="m", z_unit="ms")
    assert lines_of(read) == lines_of(SIMPLE)
    with (
        pytest.warns(UserWarning, match="left out 1 feature"),
        pytest.raises(DataError, match="does not state its x_unit; give x_unit="),
    ):
        sw.read_picks(path, TIME)


@pytest.mark.parametrize("scale", [9e-6, 1e-5, 9e-6 / 0.7])
def test_geojson_that_a_gis_has_converted_to_degrees_is_refused(tmp_path, scale):
    coordinates = [[5.4 + scale * x, 52.1 + scale * z] for x, z in SIMPLE.faults[0].points.tolist()]
    path = written(tmp_path, "a.geojson", feature(coordinates=json.dumps(coordinates)).replace(f"{MARK}, ", ""))
    with pytest.raises(DataError, match=r"all picks lie within 0\.1% of the section, near x=5.* seem to be in degrees"):
        sw.read_picks(path, DEPTH, x_unit="m", z_unit="m")


def test_a_third_coordinate_that_counts_is_refused(tmp_path):
    path = written(tmp_path, "a.json", feature(coordinates="[[0, 0, 5], [1, 1, 6]]"))
    with pytest.raises(DataError, match=r"coordinates\[0\] must be a point \[x, z\] of two numbers"):
        sw.read_picks(path, DEPTH)


@pytest.mark.parametrize("name", ["=1+1", "+F2", "-F3", "@A1", "'=quoted", "''-twice", "\t=tab", "'plain", "＝wide"])
def test_no_spreadsheet_computes_a_name(tmp_path, name):
    sw.write_picks(picks_named(name), tmp_path / "a.csv", DEPTH)
    with (tmp_path / "a.csv").open(newline="", encoding="utf-8") as file:
        cells = [row[1] for row in csv.reader(file)]
    assert all(cell[0] not in "=+-@\t\r\n＝＋－＠" for cell in cells)
    assert sw.read_picks(tmp_path / "a.csv", DEPTH).faults[0].name == name


def test_names_of_earlier_csv_files_stay(tmp_path):
    rows = "kind,name,piece,x (m),z (m)\nfault,=F1,1,0,0\nfault,=F1,1,5,9\n"
    assert sw.read_picks(written(tmp_path, "a.csv", rows), DEPTH).faults[0].name == "=F1"


# --- exports of other programs


OPENDTECT_HORIZON = """\
# "Line name" "X" "Y" "TraceNr" "ShotPointNr" "Z (ms)"
 "L 1"      100.00      500.00         1      1.00   100.000
 "L 1"      110.00      500.00         2      2.00   101.000
 "L 1"      120.00      500.00         3      3.00   1e30
 "L 1"      130.00      500.00         4      4.00   140.000
 "L 1"      140.00      500.00         5      5.00   141.000
 "L 1"      160.00      500.00         7      7.00   150.000
 "L 1"      170.00      500.00         8      8.00   151.000
 "L 2"      100.00      900.00         1      1.00   700.000
 "L 2"      110.00      900.00         2      2.00   701.000
"""
MULTI_LINE_HEADER = """\
# 1: Horizon Name
# 2: Line Name
# 3: X
# 4: Y
# 5: Trace Nr
# 6: ShotPoint Nr
# 7: Z (s)
#-------------------
 "Top" "L1"      100.00      500.00         1      1.00   0.1
 "Top" "L1"      110.00      500.00         2      2.00   0.2
"""
OPENDTECT_FAULT = "\n".join(
    f'"Big one"\t{x}\t500.0\t{z}\t{stick}\t{node}\t{line}'
    for x, z, stick, node, line in [
        (100.0, 100.0, 0, 0, "L 1"),
        (110.0, 200.0, 0, 1, "L 1"),
        (150.0, 100.0, 1, 0, "L 1"),
        (160.0, 200.0, 1, 1, "L 1"),
        (100.0, 300.0, 2, 0, "L2"),
        (110.0, 400.0, 2, 1, "L2"),
    ]
)
CHARISMA_HORIZON = """\
INLINE :    362 XLINE :    300   1000.00000   2000.00000      500.00000
INLINE :    362 XLINE :    301   1003.00000   2004.00000      501.00000
INLINE :    362 XLINE :    303   1009.00000   2012.00000      503.00000
INLINE :    362 XLINE :    304   1012.00000   2016.00000      504.00000
INLINE :    363 XLINE :    300   9000.00000   9000.00000      600.00000
"""
CHARISMA_FAULT = """\
INLINE-  362  300  1000.0  2000.0  500.0  Main fault 1
INLINE-  362  310  1030.0  2040.0  700.0  Main fault 1
INLINE-  370  300  1000.0  2000.0  500.0  Main fault 2
INLINE-  370  310  1030.0  2040.0  700.0  Main fault 2
"""
CPS3 = """\
FFASCI 1 1 "COMPUTED" 1 0
FFATTR 0 1 Z
->first
100.0 500.0 100.0
110.0 500.0 200.0
->
150.0 500.0 100.0
160.0 500.0 200.0
"""


def test_opendtect_horizons_keep_their_pieces(tmp_path):
    path = written(tmp_path, "Top.dat", OPENDTECT_HORIZON)
    choices = {"format": "opendtect-horizons", "x_unit": "m", "along": "x"}
    (horizon,) = sw.read_picks(path, TIME, line="L 1", **choices).horizons
    assert lines_of(sw.Interpretation((), (horizon,)))[1] == [
        ("Top", [[[100, 100], [110, 101]], [[130, 140], [140, 141]], [[160, 150], [170, 151]]])
    ]
    with pytest.raises(
        DataError, match=r"Top.dat holds picks on several seismic lines: 'L 1', 'L 2'; choose one with line="
    ):
        sw.read_picks(path, TIME, **choices)
    with pytest.raises(DataError, match="no picks on line='L3'; there are 'L 1', 'L 2'"):
        sw.read_picks(path, TIME, line="L3", **choices)
    with pytest.raises(DataError, match="does not state its x_unit; give x_unit="):
        sw.read_picks(path, TIME, format="opendtect-horizons", along="x", line="L 1")
    with pytest.raises(DataError, match="choose with along= how they lie along the section"):
        sw.read_picks(path, TIME, format="opendtect-horizons", x_unit="m", line="L 1")


def test_opendtect_header_of_many_rows_gives_names_and_unit(tmp_path):
    path = written(tmp_path, "many.dat", MULTI_LINE_HEADER)
    (horizon,) = sw.read_picks(path, TIME, format="opendtect-horizons", x_unit="m", along="x").horizons
    assert horizon.name == "Top"
    np.testing.assert_allclose(horizon.pieces[0], [(100, 100), (110, 200)])


def test_opendtect_horizons_without_header_need_a_unit(tmp_path):
    path = written(tmp_path, "bare.dat", "100 500 1 1 0.1\n110 500 2 2 0.2\n")
    choices = {"format": "opendtect-horizons", "x_unit": "m", "along": "x"}
    with pytest.raises(DataError, match="does not state its z_unit"):
        sw.read_picks(path, TIME, **choices)
    (horizon,) = sw.read_picks(path, TIME, z_unit="s", **choices).horizons
    assert horizon.name == "bare"


def test_opendtect_faults_are_a_fault_a_stick(tmp_path):
    path = written(tmp_path, "f.dat", OPENDTECT_FAULT)
    choices = {"format": "opendtect-faults", "x_unit": "m", "z_unit": "ms", "along": "x"}
    faults = sw.read_picks(path, TIME, line="L 1", **choices).faults
    assert [fault.name for fault in faults] == ["Big one 0", "Big one 1"]
    np.testing.assert_array_equal(faults[1].points, [(150, 100), (160, 200)])
    assert [fault.name for fault in sw.read_picks(path, TIME, line="L2", **choices).faults] == ["Big one"]


def test_charisma_horizon_lies_along_an_inline_or_a_crossline(tmp_path):
    path = written(tmp_path, "Base.txt", CHARISMA_HORIZON)
    shifted = sw.Section(DEPTH.amplitude, dx=10.0, dz=10.0, x0=50.0)
    choices = {"format": "charisma-horizons", "x_unit": "m", "z_unit": "m"}
    route = [(1000.0, 2000.0), (1600.0, 2800.0)]  # 3, 4, 5
    (horizon,) = sw.read_picks(path, shifted, line="inline 362", along=route, **choices).horizons
    np.testing.assert_allclose(horizon.pieces[0], [(50, 500), (55, 501)], rtol=1e-12)
    np.testing.assert_allclose(horizon.pieces[1], [(65, 503), (70, 504)], rtol=1e-12)
    (cross,) = sw.read_picks(
        path, DEPTH, line="xline 300", along=lambda x, y, trace: 25.0 * (trace - 362), **choices
    ).horizons
    np.testing.assert_array_equal(cross.pieces[0], [(0, 500), (25, 600)])
    far = sw.Section(DEPTH.amplitude, dx=0.01, dz=10.0, x0=5.0, x_unit="km")  # what is distance comes in metres here
    (in_km,) = sw.read_picks(path, far, line="inline 362", along=route, **choices).horizons
    np.testing.assert_allclose(in_km.pieces[0][:, 0], 5.0 + (horizon.pieces[0][:, 0] - 50.0) / 1000)
    with pytest.raises(DataError, match=r"row 5 lies .* beside the line given as along="):
        sw.read_picks(path, DEPTH, line="inline 363", along=route, **choices)


@pytest.mark.parametrize(
    "marks", ["INLINE :{} XLINE :{}", "INLINE-{} XLINE-{}", "INLINE - {} XLINE - {}", "INLINE {} XLINE {}"]
)
def test_charisma_marks_stand_apart_or_joined(tmp_path, marks):
    rows = "".join(f"{marks.format(362, 300 + n)} {25 * n} 0 {500 + n}\n" for n in range(3))
    choices = {"x_unit": "m", "z_unit": "m", "along": "x", "line": "inline 362"}
    horizons = sw.read_picks(written(tmp_path, "Base.txt", rows), DEPTH, format="charisma-horizons", **choices)
    rows = rows.replace("\n", " 1\n")  # the number of the stick
    faults = sw.read_picks(written(tmp_path, "F.txt", rows), DEPTH, format="charisma-faults", **choices)
    points = [[0, 500], [25, 501], [50, 502]]
    assert lines_of(horizons) == ([], [("Base", [points])])
    assert lines_of(faults) == ([("F", [points])], [])


def test_charisma_rows_may_end_with_the_horizons_name(tmp_path):
    path = written(tmp_path, "all.txt", CHARISMA_HORIZON.replace("0\n", "0 Base Chalk\n"))
    choices = {"format": "charisma-horizons", "x_unit": "m", "z_unit": "m", "along": "x", "line": "inline 362"}
    assert [horizon.name for horizon in sw.read_picks(path, DEPTH, **choices).horizons] == ["Base Chalk"]
    written(tmp_path, "all.txt", CHARISMA_HORIZON.replace("0\n", "0 0.77\n"))
    with pytest.raises(DataError, match="row 1 must be INLINE : number XLINE : number X Y Z and an optional name"):
        sw.read_picks(path, DEPTH, **choices)


@pytest.mark.parametrize("undefined", ["9999999", "9999900.0", "1e30", "-1e30", "3.4028235e+38", "-"])
def test_a_fault_leaves_out_points_without_depth(tmp_path, undefined):
    path = written(tmp_path, "f.txt", CHARISMA_FAULT + f"INLINE- 370 320 1060.0 2080.0 {undefined} Main fault 2\n")
    choices = {"format": "charisma-faults", "x_unit": "m", "z_unit": "m", "along": "x"}
    (fault,) = sw.read_picks(path, DEPTH, line="inline 370", **choices).faults
    np.testing.assert_array_equal(fault.points, [(1000, 500), (1030, 700)])


def test_choices_of_exports_have_no_meaning_for_ours(tmp_path):
    sw.write_picks(SIMPLE, tmp_path / "a.csv", TIME)
    for name, value in (("along", "x"), ("line", "L 1")):
        with pytest.raises(sw.SettingError, match=f"{name}= has no meaning for csv"):
            sw.read_picks(tmp_path / "a.csv", TIME, **{name: value})


def test_charisma_faults_may_have_blanks_in_their_names(tmp_path):
    path = written(tmp_path, "f.txt", CHARISMA_FAULT)
    choices = {"format": "charisma-faults", "x_unit": "m", "z_unit": "m", "along": "x"}
    (fault,) = sw.read_picks(path, DEPTH, line="inline 370", **choices).faults
    assert fault.name == "Main fault"
    np.testing.assert_array_equal(fault.points, [(1000, 500), (1030, 700)])


def test_cps3_lines_are_faults_or_the_pieces_of_a_horizon(tmp_path):
    path = written(tmp_path, "lines.cps3", CPS3)
    choices = {"x_unit": "m", "z_unit": "m", "along": "x"}
    faults = sw.read_picks(path, DEPTH, format="cps3-faults", **choices).faults
    assert [fault.name for fault in faults] == ["lines 1", "lines 2"]
    (horizon,) = sw.read_picks(path, DEPTH, format="cps3-horizons", **choices).horizons
    assert [piece.tolist() for piece in horizon.pieces] == [fault.points.tolist() for fault in faults]


def test_points_that_stand_alone_are_left_out_with_a_warning(tmp_path):
    path = written(tmp_path, "Top.dat", OPENDTECT_HORIZON.replace("140.000\n", "1e30\n"))
    with pytest.warns(UserWarning, match="left out 1 single point that cannot form a line, of 'Top'") as warned:
        (horizon,) = sw.read_picks(path, TIME, format="opendtect-horizons", x_unit="m", along="x", line="L 1").horizons
    assert len(horizon.pieces) == 2
    assert warned[0].filename == __file__


# --- what cannot be read


HEADER = "kind,name,piece,x (m),z (m)\n"
MARK = '"seiswidgets_picks": {"version": 1, "x_unit": "m", "z_unit": "m"}'


def feature(kind="fault", geometry="LineString", coordinates="[[0, 0], [1, 1]]", name='"F"'):
    return (
        f'{{{MARK}, "features": [{{"properties": {{"kind": "{kind}", "name": {name}}}, '
        f'"geometry": {{"type": "{geometry}", "coordinates": {coordinates}}}}}]}}'
    )


@pytest.mark.parametrize(
    ("name", "text", "match"),
    [
        ("a.csv", "", "a.csv is empty; its first row must name the columns kind, name"),
        ("a.csv", "x,z\n1,2\n", "row 1 must name the columns .* missing or repeated: kind, name, piece"),
        ("a.csv", HEADER + "fault,F,1,a,2\n", "row 2: x must be a number .* 'a'"),
        ("a.csv", HEADER + "fault,F,1,1,nan\n", "row 2: z must be a number .* 'nan'"),
        ("a.csv", HEADER + "fault,F,1,1,1e300\n", "row 2: z must be a number"),
        ("a.csv", HEADER + "fault,F,1,1\n", "row 2 must have 5 values like the first row, but has 4"),
        ("a.csv", HEADER + "dyke,F,1,1,1\n", "row 2: kind must be 'fault', 'horizon' or 'body', but is 'dyke'"),
        ("a.csv", HEADER + 'fault,"F,1,1,1\n', "row 2 is not CSV"),
        ("a.csv", HEADER + "fault,F,1,1,1\n", "row 2: fault 'F' needs at least two different points"),
        ("a.csv", HEADER + "fault,F,1,1,1\nfault,F,1,2,2\nfault,F,2,1,1\n", "row 4 is a second line of fault 'F'"),
        ("a.csv", HEADER.encode() + b"fault,\xe4,1,1,1\n", "not UTF-8 text: byte 0xe4 at 34"),
        ("a.csv", HEADER.replace("(m)", "(yd)") + "fault,F,1,1,1\nfault,F,1,2,2\n", "x_unit must be one of .* 'yd'"),
        (
            "a.csv",
            HEADER + f"fault,{'long ' * 9000},1,1,1\n",
            "row 2: fault 'long long .* [.]{3} .* needs at least two",
        ),
        ("a.json", "{", "a.json is not valid JSON"),
        ("a.json", "[" * 100_000, "nested more deeply"),
        ("a.json", "[]", "must be an object .* but is a list of 0"),
        ("a.json", '{"type": "FeatureCollection"}', "lacks 'features'"),
        ("a.json", feature().replace('"version": 1', '"version": 9'), "version 9 .* update seiswidgets"),
        ("a.json", feature(coordinates="[[0, 0], [1, NaN]]"), "NaN is not a number in JSON"),
        (
            "a.json",
            feature(coordinates="[[0, 0], [1, 1e999]]"),
            r"features\[0\].geometry.coordinates\[1\] must be a poi",
        ),
        ("a.json", feature(coordinates="[[0, 0], [true, 1]]"), r"coordinates\[1\] must be a point"),
        ("a.json", feature(coordinates=f"[[0, 0], [1, {'9' * 4000}]]"), r"coordinates\[1\] must be a point"),
        ("a.json", feature(coordinates=f"[[0, 0], [1, {'9' * 5000}]]"), "is not valid JSON"),
        ("a.json", feature(coordinates='"no"'), "coordinates must be a list of points"),
        ("a.json", feature(kind="dyke"), r"features\[0\].properties.kind must be 'fault', 'horizon' or 'body'"),
        ("a.json", feature(geometry="Polygon"), r"geometry.type must be 'LineString' for a fault"),
        ("a.json", feature("horizon", "MultiLineString", "[]"), "must be a list of pieces"),
        ("a.json", feature(name="7"), "properties.name must be text, but is 7"),
        ("a.json", feature(name='"\\ud800"'), "properties.name must be text"),
    ],
)
def test_what_cannot_be_read_is_an_error_that_says_where(tmp_path, name, text, match):
    path = written(tmp_path, name, text)
    with pytest.raises(DataError, match=match) as caught:
        sw.read_picks(path, DEPTH)
    assert str(path) in str(caught.value)
    assert len(str(caught.value)) < 2000


@pytest.mark.parametrize(
    ("kind", "text", "match"),
    [
        ("opendtect-horizons", "", "holds no picks"),
        ("opendtect-horizons", "1 2 3\n", "row 1 must be names in quotes .* 0 names and 3 values"),
        ("opendtect-horizons", "a b 3 4 5\n", "row 1: x must be a number .* 'b'"),
        ("opendtect-faults", "1\t2\t3\t4\n", "row 1 must be an optional fault name .* with both indices"),
        ("charisma-horizons", "INLINE : 1 2 3 4\n", "row 1 must be INLINE : number XLINE : number X Y Z"),
        ("charisma-faults", "INLINE- 1 2 3 4 5 six\n", "row 1 must be INLINE- inline crossline X Y Z"),
        ("cps3-faults", "->\n1 2\n", "row 2 must be X, Y and Z, but has 2 values"),
    ],
)
def test_exports_that_are_not_as_documented_are_refused(tmp_path, kind, text, match):
    path = written(tmp_path, "export.txt", text)
    with pytest.raises(DataError, match=match) as caught:
        sw.read_picks(path, DEPTH, format=kind, x_unit="m", z_unit="m", along="x")
    assert str(path) in str(caught.value)


@pytest.mark.parametrize(
    ("along", "match"),
    [
        ("trace", "along= must be 'x', 'y', a function, or a list of two or more points"),
        ([(0, 0)], "along= must be"),
        ([(1, 1), (1, 1)], "along= must be"),
        (lambda x, y, trace: x[:1], r"must return a finite number for each of 2 points"),
        (lambda x, y, trace: x * np.nan, r"must return a finite number"),
        (lambda x, y, trace: "left", r"must return a finite number for each of 2 points, but returned 'left'"),
    ],
)
def test_a_place_on_the_section_must_be_found(tmp_path, along, match):
    path = written(tmp_path, "a.dat", '"F"\t1\t2\t3\t0\t0\n"F"\t2\t3\t4\t0\t1\n')
    with pytest.raises(DataError, match=match):
        sw.read_picks(path, DEPTH, format="opendtect-faults", x_unit="m", z_unit="m", along=along)


def test_the_format_is_told_by_the_suffix_or_asked_for(tmp_path):
    path = written(tmp_path, "a.dat", "")
    with pytest.raises(
        SettingError, match=r"its suffix does not tell its format; give format=, one of geojson, csv, opendtect"
    ):
        sw.read_picks(path, DEPTH)
    with pytest.raises(SettingError, match=r"format= must be one of geojson, csv, .*, but is 'charisma-faults'"):
        sw.write_picks(SIMPLE, path, DEPTH, format="charisma-faults")


def test_files_that_are_not_there_or_too_large_are_not_read(tmp_path):
    with pytest.raises(DataError, match="there is no file"):
        sw.read_picks(tmp_path / "none.csv", DEPTH)
    with pytest.raises(DataError, match="there is no file"):
        sw.read_picks(tmp_path, DEPTH, format="csv")
    for name, size in (("a.json", 9 * 2**20), ("a.csv", 9 * 2**20)):
        path = written(tmp_path, name, "")
        os.truncate(path, size)  # sparse
        with pytest.raises(DataError, match=r"holds \d+ MiB, but the limit for the picks of one section is"):
            sw.read_picks(path, DEPTH)


def test_more_points_than_there_may_be_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("seiswidgets.io.picks.map_points.MOST_POINTS", 2)
    with pytest.raises(DataError, match=r"a.cps3: row 7 exceeds the limit of 2 points on a line"):
        sw.read_picks(written(tmp_path, "a.cps3", CPS3), DEPTH, format="cps3-faults", along="x")


def test_rows_are_counted_as_editors_count_them(tmp_path):
    path = written(tmp_path, "a.cps3", "# a\x0bb\x85c\u2028d\r\n\r1 2 3\n1 2 none\n")
    with pytest.raises(DataError, match=r"a.cps3: row 4: Z must be a number"):
        sw.read_picks(path, DEPTH, format="cps3-faults", along="x")


def test_what_could_not_be_read_again_is_not_written(tmp_path):
    x = np.linspace(0, 1, 250_000) / 3
    with pytest.raises(
        DataError, match=r"a.json would hold 1\d MiB, more than the 8 MiB that can be read again; keep fewer points"
    ):
        sw.write_picks(picks(F1=[np.column_stack([x, x])]), tmp_path / "a.json", DEPTH)
    assert not list(tmp_path.iterdir())


def test_a_long_line_that_crosses_itself_is_found_at_once(tmp_path):
    turn = np.linspace(0, 40 * np.pi, 20_000)
    points = np.column_stack([turn + 5 * np.cos(turn), 5 * np.sin(turn)]).tolist()
    path = written(tmp_path, "a.json", feature(coordinates=json.dumps(points)))
    begun = time.process_time()
    assert "fault 'F' crosses itself near x=" in str(sw.read_picks(path, DEPTH).fault("F").flaw)
    assert time.process_time() - begun < 2


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        ("csv", f"kind{' ' * 300_000}x,name,piece,x,z\n"),
        ("csv", f"{'kind' * 100_000} (,name,piece,x,z\n"),
        ("opendtect-horizons", '"' * 1_000_001),
        ("opendtect-horizons", f"# {'Z (m' * 100_000}\n1 2 3\n"),
        ("charisma-horizons", f"INLINE {':' * 300_000}\n"),
        ("charisma-faults", f"INLINE{' ' * 300_000}x\n"),
    ],
)
def test_endless_rows_are_refused_at_once(tmp_path, kind, text):
    path = written(tmp_path, "a.txt", text)
    begun = time.process_time()
    with pytest.raises(DataError, match=r"a.txt: row \d"):
        sw.read_picks(path, DEPTH, format=kind)
    assert time.process_time() - begun < 2


@pytest.mark.parametrize("name", FORMATS)
def test_a_file_that_cannot_be_replaced_stays_as_it_was(tmp_path, name, monkeypatch):
    sw.write_picks(SIMPLE, tmp_path / name, DEPTH)
    before = (tmp_path / name).read_bytes()

    def full(*args):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(DataError, match="cannot be written: No space left on device; free some space"):
        sw.write_picks(sw.Interpretation(), tmp_path / name, DEPTH)
    assert (tmp_path / name).read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == [name]


def test_half_a_character_in_a_name_cannot_be_written_as_csv(tmp_path):
    with pytest.raises(DataError, match="a name contains an unpaired surrogate"):
        sw.write_picks(picks(**{"F\ud800": [[(0, 0), (1, 1)]]}), tmp_path / "a.csv", DEPTH)
    assert not list(tmp_path.iterdir())
