"""Exports of other programs in their real layouts: read, or refused with the format that they look like."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.errors import DataError, SettingError

SECTION = sw.Section(np.ones((201, 41)), dx=12.5, dz=4, z_unit="ms", velocity=2000, name="L 1")
INLINES, CROSSLINES = range(100, 106, 2), range(300, 309)
COURSE = [(450_000, 6_700_050), (450_500, 6_700_050)]  # of inline 102, on which X begins at crossline 300


def grid():
    """Inline, crossline, X, Y and Z of a 3-D horizon; no pick at crossline 304."""
    for inline in INLINES:
        for crossline in CROSSLINES:
            if crossline != 304:
                x, y = 450_000 + 12.5 * (crossline - 300), 6_700_000 + 25 * (inline - 100)
                yield inline, crossline, x, y, 300 + 2 * (crossline - 300) + inline - 100


def table(pattern, header="", end=""):
    rows = (pattern.format(i=i, c=c, x=x, y=y, z=z) for i, c, x, y, z in grid())
    return header + "\n".join(rows) + "\n" + end


def iesx(i, c, x, y, z, stick=0):
    mark = "XX".ljust(52)
    return f"{x:16.8E}{y:16.8E}{stick:3d}{14:3d}{z:9.2f}{c:10.2f}{c:10.2f}{c:5d}{3.4028235e38:14.7E} I{i:7d} {mark}"


PROFILE = f"PROFILE Top              TYPE 1  4 {'':45}3d_ci7m.ifdf     m  ms\nSNAPPING PARAMETERS 5     0 1\n"
IESX = PROFILE + "\n".join(iesx(*row) for row in grid()) + "\nEOD\n"
EARTHVISION = "# Type: scattered data\n# Version: 6\n# Format: free\n# Field: 1 x\n# Field: 2 y\n# Field: 3 z ms\n"
EARTHVISION += "# Field: 4 Inline\n# Field: 5 Crossline\n# Projection: Local Rectangular\n# Units: meters\n# End:\n"
ODT, NAMED = "# - - - - - - - - - -\n", '"X"\t"Y"\t"Inline"\t"Crossline"\t"Z"'
GRIDS = {  # 3-D horizons: format, text, and keywords that the file does not make needless
    "OpendTect, one row": (
        "opendtect",
        table("{x}\t{y}\t{i}\t{c}\t{z}", f'# "X"\t"Y"\t"Inline"\t"Crossline"\t"Z"\n{ODT}'),
    ),
    "OpendTect, a row each": (
        "opendtect",
        table("{x}\t{y}\t{i}\t{c}\t{z}", f"# 1: X\n# 2: Y\n# 3: Inline\n# 4: Crossline\n# 5: Z\n{ODT}"),
    ),
    "OpendTect, named": (
        "opendtect",
        table('"Top"\t{x}\t{y}\t{i}\t{c}\t{z}', '# "X"\t"Y"\t"Inline"\t"Crossline"\t"Z"\n'),
    ),
    "OpendTect, no header": ("opendtect", table("{x:.2f}\t{y:.2f}\t{i}\t{c}\t{z}")),
    "Charisma of Petrel": ("charisma", table("INLINE :{i:7} XLINE :{c:7}{x:16.5f}{y:16.5f}{z:16.5f}")),
    "Charisma, lower case": ("charisma", table("inline:{i} xline:{c}\t{x}\t{y}\t{z}", "# picks\nInline Xline X Y Z\n")),
    "Charisma, one mark": ("charisma", table("INLINE- {i} {c} {x} {y} {z}")),
    "Charisma, name first": ("charisma", table('"Top" INLINE : {i} XLINE : {c} {x} {y} {z}')),
    "IESX": ("iesx", IESX),
    "IESX of OpendTect": ("iesx", IESX.replace("\n  4", "\nEOD  4")),
    "EarthVision": ("earthvision", table("{x} {y} {z} {i} {c}", EARTHVISION)),
    "Kingdom": ("kingdom", table("{i} {c} {x:.2f} {y:.2f} {z:.3f}", "Line Trace X Y Time\n")),
    "Kingdom, commas": (
        "kingdom",
        table("Top,{i},{c},{x},{y},{z}", "Horizon,Inline,Crossline,Easting,Northing,TWT (ms)\n"),
    ),
    "GeoGraphix": ("geographix", table("{i}\t{c}\t{x}\t{y}\t{z}", "Line\tTrace\tX\tY\tTime [ms]\n")),
}


@pytest.fixture
def write(tmp_path):
    def write(text, name="Top.dat"):
        (tmp_path / name).write_text(text)
        return tmp_path / name

    return write


def read(path, kind, **choices):
    given = {"x_unit": "m", "z_unit": "ms", "along": COURSE} | choices
    return sw.read_picks(
        path, SECTION, format=kind, **{name: value for name, value in given.items() if value is not None}
    )


@pytest.mark.parametrize("layout", GRIDS)
def test_a_line_of_a_3d_horizon_is_read(write, layout):
    family, text = GRIDS[layout]
    path = write(text)
    (horizon,) = read(path, f"{family}-horizons", line="inline 102").horizons
    assert horizon.name == "Top"
    expected = [(12.5 * (c - 300), z) for i, c, _, _, z in grid() if i == 102]
    np.testing.assert_allclose(np.concatenate(horizon.pieces), expected, atol=1e-2)
    assert [len(piece) for piece in horizon.pieces] == [4, 4]
    across = [(450_025, 6_700_000), (450_025, 6_700_100)]
    (horizon,) = read(path, f"{family}-horizons", line="xline 302", along=across).horizons
    np.testing.assert_allclose(horizon.pieces[0], [(0, 304), (50, 306), (100, 308)])
    with pytest.raises(DataError, match=r"a 3-D horizon .* several seismic lines: 'inline 100'.*choose one with line="):
        read(path, f"{family}-horizons")


WITH_COLUMNS = {"kingdom", "geographix", "earthvision", "opendtect", "dug"}  # whose columns have names alike
GIVEN = ("opendtect", "charisma", "iesx", "earthvision", "cps3", "kingdom", "dug")
OTHERS = [
    (layout, given)
    for layout, (family, _) in GRIDS.items()
    for given in GIVEN
    if given != family and not {given, family} <= WITH_COLUMNS
]


@pytest.mark.parametrize(("layout", "given"), OTHERS)
def test_an_export_is_not_read_as_another_layout(write, layout, given):
    with pytest.raises(DataError, match=r"Top\.dat"):
        read(write(GRIDS[layout][1]), f"{given}-horizons", line="inline 102")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (IESX, "looks like IESX .*, not like OpendTect; give format='iesx-horizons'"),
        (GRIDS["Charisma of Petrel"][1], "looks like Charisma, not like OpendTect; give format='charisma-horizons'"),
        (GRIDS["EarthVision"][1], "looks like EarthVision, not like OpendTect; give format='earthvision-horizons'"),
        ("->\n1 2 3\n", "looks like CPS-3, not like OpendTect; give format='cps3-horizons'"),
        ("# Petrel Points with attributes\n", "looks like Petrel's points .* give format='petrel-points'"),
        ("# vertical_unit=ms\n1 2 3\n", "looks like DUG Insight.* give format='dug-horizons'"),
        ("FSASCI 0 1 COMPUTED 0 1E30\n", "looks like a CPS-3 grid, not like OpendTect; export the picks in one of its"),
        ("@Grid HEADER, GRID, 5\n", "looks like a ZMAP"),
        ("-996 41 12.5 12.5\n", "looks like an Irap classic grid"),
        ("GOCAD PLine 1\n", "looks like GOCAD"),
        ('{"type": "FeatureCollection"}', "looks like JSON"),
        ("kind,name,piece,x (m),z (m)\n", "looks like the CSV of seiswidgets"),
        ("1 2 3\n4 5 6\n", "0 names and 3 values; export it again, with Z and a header"),
        (
            '"F"\t1\t2\t3\t0\t0\n"F"\t1\t2\t4\t0\t1\n',
            "stick and node index of faults.* format='opendtect-faults'",
        ),
    ],
)
def test_the_format_that_a_file_looks_like_is_named(write, text, said):
    with pytest.raises(DataError, match=said):
        read(write(text), "opendtect-horizons", line="inline 102")


def test_horizons_are_not_read_as_faults(write):
    text = "".join(f'"L 1"\t{x}\t500\t{x}\t{x}\t{300 + x}\n' for x in range(5))
    with pytest.raises(DataError, match=r"node index must count up from 0.* format='opendtect-horizons'"):
        read(write(text), "opendtect-faults", along="x")
    with pytest.raises(DataError, match="no column for the number of the stick"):
        read(write(GRIDS["Kingdom"][1]), "kingdom-faults", along="x")


@pytest.mark.parametrize("layout", ["{x}\t{y}\t{z}", "{x} {y} {z} 1"])
@pytest.mark.parametrize("family", ["kingdom", "geographix", "opendtect"])
def test_a_3d_horizon_without_line_numbers_is_refused(write, layout, family):
    header = "X\tY\tZ (ms)\n" if "\t" in layout else "X Y Time Amplitude\n"
    with pytest.raises(DataError, match=r"3-D horizon without line numbers.* export it with inline and crossline"):
        read(write(table(layout, f"# {header}")), f"{family}-horizons", along="x")


def test_columns_without_names_are_refused(write):
    for family in ("kingdom", "geographix", "earthvision"):
        with pytest.raises(DataError, match="does not say what its columns are: its first row must name"):
            read(write(table("{i} {c} {x} {y} {z}")), f"{family}-horizons")


LINE_ROWS = [(12.5 * n, 300 + n) for n in range(6)]
OLD = "".join(f"{'L-1':>15}{x:16.2f}{500:16.2f}{n:8d}{z:16.4f}\n" for n, (x, z) in enumerate(LINE_ROWS, 1))
LINES = {  # 2-D horizons along X
    "OpendTect 4, a row each": ("opendtect", f"# 1: LineName\n# 2: X\n# 3: Y\n# 4: TraceNr\n# 5: Z(ms)\n{ODT}{OLD}"),
    "OpendTect 4, one row": ("opendtect", f'# "Line name"\t"X"\t"Y"\t"TrcNr"\t"Z(ms)"\n#----\n{OLD}'),
    "OpendTect 4, no header": ("opendtect", OLD),
    "OpendTect 4, no line": ("opendtect", '#  "X"\t"Y"\t"Z(ms)"\n' + "".join(f"{x}\t500\t{z}\n" for x, z in LINE_ROWS)),
    "Kingdom 2-D": (
        "kingdom",
        "Line Name,Shotpoint,X,Y,Time (ms)\n" + "".join(f"L-1,{n},{x},500,{z}\n" for n, (x, z) in enumerate(LINE_ROWS)),
    ),
    "GeoGraphix 2-D": (
        "geographix",
        "Line\tSP\tX\tY\tTWT\n" + "".join(f"L-1\t{n}\t{x}\t500\t{z}\n" for n, (x, z) in enumerate(LINE_ROWS)),
    ),
    "DUG": ("dug", "# vertical_dimension=TWT\n# vertical_unit=ms\n" + "".join(f"{x} 500 {z}\n" for x, z in LINE_ROWS)),
}


@pytest.mark.parametrize("layout", LINES)
def test_a_2d_horizon_is_read(write, layout):
    family, text = LINES[layout]
    units = {"z_unit": None if "ms" in text else "ms"}
    (horizon,) = read(write(text), f"{family}-horizons", along="x", **units).horizons
    np.testing.assert_allclose(np.concatenate(horizon.pieces), LINE_ROWS)


def test_numbers_of_traces_may_take_the_place_of_positions(write):
    path = write(table("{i} {c} {z}", "# subgrid=il:100-104[2]+cl:300-308[1]\n# vertical_unit=ms\n"), "Top.ilclt")
    along = lambda x, y, trace: 12.5 * (trace - 300)  # noqa: E731
    (horizon,) = read(path, "dug-horizons", line="inline 104", along=along, z_unit=None).horizons
    assert horizon.pieces[0][0].tolist() == [0, 304]
    with pytest.raises(DataError, match=r"gives no X and Y.* give along= as a function"):
        read(path, "dug-horizons", line="inline 104", along="x", z_unit=None)


STICKS = [("F 1", 1, [(10.0, 100.0), (20.0, 200.0), (30.0, 300.0)]), ("F2", 1, [(200.0, 40.0), (180.0, 90.0)])]
FAULTS = {
    "IESX": (
        "iesx",
        "".join(
            f"PROFILE {name:17}TYPE 1  1 {'':45}fault_gf.ifdf    m  ms\n"
            + "".join(iesx(102, 300, x, 500, z, stick) + "\n" for x, z in points)
            + "EOD\n"
            for name, stick, points in STICKS
        ),
    ),
    "Charisma": (
        "charisma",
        "".join(f"INLINE-\t102\t300\t{x}\t500\t{z}\t{name}\t{s}\n" for name, s, points in STICKS for x, z in points),
    ),
    "Charisma, colons": (
        "charisma",
        "".join(
            f'INLINE : 102 XLINE : 300 {x} 500 {z} "{name}" {s}\n' for name, s, points in STICKS for x, z in points
        ),
    ),
    "Kingdom": (
        "kingdom",
        "Fault Name,Stick,X,Y,TWT(ms)\n"
        + "".join(f"{name},{s},{x},500,{z}\n" for name, s, points in STICKS for x, z in points),
    ),
    "GeoGraphix": (
        "geographix",
        "Fault\tSegment\tX\tY\tTime\n"
        + "".join(f"{name}\t{s}\t{x}\t500\t{z}\n" for name, s, points in STICKS for x, z in points),
    ),
}


@pytest.mark.parametrize("layout", FAULTS)
def test_fault_sticks_are_read(write, layout):
    family, text = FAULTS[layout]
    line = "inline 102" if family in ("iesx", "charisma") else None
    faults = read(write(text), f"{family}-faults", along="x", line=line).faults
    assert [(fault.name, fault.points.tolist()) for fault in faults] == [
        (name, [list(point) for point in points]) for name, _, points in STICKS
    ]


def test_blank_rows_separate_the_sticks_of_dug(write):
    text = "\n\n".join("\n".join(f"{x} 500 {z}" for x, z in points) for _, _, points in STICKS)
    faults = read(write(text, "Main.dufault"), "dug-faults", along="x").faults
    assert [(fault.name, len(fault.points)) for fault in faults] == [("Main 1", 3), ("Main 2", 2)]


def test_petrel_points_of_others_are_a_horizon(write):
    header = "# Petrel Points with attributes\n# Unit in X and Y direction: m\n# Unit in depth: ms\nVERSION 1\n"
    header += "BEGIN HEADER\nX\nY\nZ\nFLOAT,Amplitude\nEND HEADER\n"
    text = header + "".join(f"{x} 500 {-z} 0.5\n" for x, z in LINE_ROWS)
    (horizon,) = read(write(text), "petrel-points", along="x", z_up=True, x_unit=None, z_unit=None).horizons
    np.testing.assert_allclose(horizon.pieces[0], LINE_ROWS)
    with pytest.raises(DataError, match=r"all z are negative.* z_up=True"):
        read(write(text), "petrel-points", along="x")
    with pytest.raises(DataError, match="must have a header from BEGIN HEADER"):
        read(write("1 2 3\n"), "petrel-points", along="x")


# --- written


PICKS = sw.Interpretation(
    (sw.Fault([(210, 0), (260, 400)], "F 1"), sw.Fault([(300, 100), (330, 500.25)], "F2")),
    (
        sw.Horizon([(0, 100), (200, 120)], [(212.5, 160), (500, 200)], name="Top A"),
        sw.Horizon([(0, 300), (237.5, 310), (500, 305)], name="Base"),
    ),
)
ROUTES = ["x", "y", [(450_000, 6_700_050), (450_600, 6_700_050)], [(0, 0), (300, 400), (300, 700)]]


def lines_of(picks):
    return [(fault.name, fault.points.tolist()) for fault in picks.faults], [
        (horizon.name, [piece.tolist() for piece in horizon.pieces]) for horizon in picks.horizons
    ]


@pytest.mark.parametrize("along", ROUTES)
@pytest.mark.parametrize("x0", [0.0, -40.0])
def test_petrel_points_come_back(tmp_path, along, x0):
    section = sw.Section(SECTION.amplitude, dx=15, dz=4, x0=x0, z_unit="ms", velocity=2000)
    sw.write_picks(PICKS, tmp_path / "p.txt", section, format="petrel-points", along=along)
    again = sw.read_picks(tmp_path / "p.txt", section, format="petrel-points", along=along, z_up=True)
    for ours, theirs in zip(lines_of(PICKS), lines_of(again), strict=True):
        assert [name for name, _ in ours] == [name for name, _ in theirs]
        for (_, one), (_, other) in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(
                np.hstack(list(map(np.ravel, one))), np.hstack(list(map(np.ravel, other))), atol=1e-6
            )


@pytest.mark.parametrize("along", ROUTES)
def test_opendtect_faults_come_back(tmp_path, along):
    sw.write_picks(PICKS, tmp_path / "f.dat", SECTION, format="opendtect-faults", along=along)
    units = {"x_unit": "m", "z_unit": "ms"}
    again = sw.read_picks(tmp_path / "f.dat", SECTION, format="opendtect-faults", along=along, line="L 1", **units)
    for fault, other in zip(PICKS.faults, again.faults, strict=True):
        assert fault.name == other.name
        np.testing.assert_allclose(fault.points, other.points, atol=1e-6)


@pytest.mark.parametrize("along", ROUTES)
def test_opendtect_horizons_come_back_at_the_traces(tmp_path, along):
    sw.write_picks(PICKS, tmp_path / "h.dat", SECTION, format="opendtect-horizons", along=along, line="my line")
    again = sw.read_picks(
        tmp_path / "h.dat", SECTION, format="opendtect-horizons", along=along, line="my line", x_unit="m"
    )
    assert [horizon.name for horizon in again.horizons] == ["Top A", "Base"]
    for horizon, other in zip(PICKS.horizons, again.horizons, strict=True):
        assert len(other.pieces) == len(horizon.pieces)
        for piece, sampled in zip(horizon.pieces, other.pieces, strict=True):
            ordered = sampled[np.argsort(sampled[:, 0])]
            np.testing.assert_allclose(ordered[[0, -1], 0], piece[[0, -1], 0], atol=0.02)
            np.testing.assert_allclose(ordered[:, 1], np.interp(ordered[:, 0], *piece.T), atol=0.02)


@pytest.mark.parametrize(
    ("picks", "choices", "error", "match"),
    [
        (PICKS, {"along": None}, SettingError, "needs positions on a map; give along="),
        (PICKS, {"along": [(0, 0), (100, 0)]}, DataError, "reach from 0 to 200 along the line .* which is 100 long"),
        (sw.Interpretation((), ()), {}, DataError, "there is no horizon to write in this format"),
        (
            sw.Interpretation((), (sw.Horizon([(0, 1), (200, 2)], [(100, 9), (300, 9)], name="H"),)),
            {},
            DataError,
            "'H' has two depths at one trace",
        ),
        (
            sw.Interpretation((), (sw.Horizon([(0, 1), (200, 2), (100, 9)], name="H"),)),
            {},
            DataError,
            "'H' is overturned near x=0",
        ),
    ],
)
def test_picks_that_opendtect_cannot_hold_are_refused(tmp_path, picks, choices, error, match):
    with pytest.raises(error, match=match):
        sw.write_picks(picks, tmp_path / "h.dat", SECTION, format="opendtect-horizons", **({"along": "x"} | choices))
    assert not (tmp_path / "h.dat").exists()
    with pytest.raises(SettingError, match="along= has no meaning for csv"):
        sw.write_picks(PICKS, tmp_path / "h.csv", SECTION, along="x")
