"""Balance and histories, against synthetic sections whose lengths, areas, throws and growth are known."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.sections import real_section


def unfaulted(case, spacing=100.0):
    picks = case.interpretation
    return sw.Restoration(case.section, spacing=spacing).unfault(picks.faults, picks.horizons, fixed=case.fixed)


@pytest.mark.parametrize(
    "case", [sw.synthetic.domino(), sw.synthetic.faulted_fold()], ids=lambda case: case.section.name
)
def test_a_section_of_plane_strain_balances(case):
    balance = sw.balance(unfaulted(case), case.interpretation)
    assert not balance.findings
    x_min, x_max, z_min, z_max = case.section.extent
    assert len(balance.layers) == len(case.interpretation.horizons) + 1
    np.testing.assert_allclose(
        sum(layer.area for layer in balance.layers), (x_max - x_min) * (z_max - z_min), rtol=1e-6
    )
    for layer in balance.layers:
        assert abs(layer.change) < 1e-3
    for bed in balance.beds:
        np.testing.assert_allclose(bed.closed, bed.heave, rtol=1e-4)


def test_extension_and_beta_are_those_of_the_heave_on_level_beds():
    case = sw.synthetic.planar_fault(throw=100)
    heave = 100 / np.tan(np.deg2rad(60))
    for bed in sw.balance(unfaulted(case), case.interpretation).beds:
        np.testing.assert_allclose(bed.beta, 4000 / (4000 - heave), rtol=1e-6)
        np.testing.assert_allclose(bed.extension, heave / (4000 - heave), rtol=1e-5)


def test_a_sheared_edge_is_a_tilted_loose_line():
    case = sw.synthetic.domino()
    left, right = sw.balance(unfaulted(case), case.interpretation).edges
    assert max(left.bend, right.bend) < 0.01
    thrust = sw.synthetic.thrust()
    assert [finding.kind for finding in sw.balance(unfaulted(thrust), thrust.interpretation).findings] == ["loose line"]


def test_what_does_not_balance_is_said():
    section, picks = real_section("f3")
    restored = sw.Restoration(section).unfault(picks.faults, picks.horizons)
    balance = sw.balance(restored, picks)
    assert {finding.kind for finding in balance.findings} == {"heave"}
    assert "of the heave of horizon lower closes" in str(balance)


def test_there_must_be_a_stage():
    case = sw.synthetic.planar_fault()
    with pytest.raises(sw.SettingError, match="nothing has been restored yet"):
        sw.balance(sw.Restoration(case.section), case.interpretation)


def test_throw_heave_and_slip_at_each_horizon():
    case = sw.synthetic.planar_fault(throw=-90)
    table = sw.fault_throws(case.section, case.interpretation)
    np.testing.assert_allclose(table.column("throw"), -90, atol=1e-6)
    np.testing.assert_allclose(table.column("slip"), -90 / np.sin(np.deg2rad(60)), atol=1e-6)
    assert table.column("age") == [None] * 3
    assert table.column("depth") == sorted(table.column("depth"))


def test_the_growth_of_a_fault_is_its_steps_of_slip():
    basin = sw.synthetic.growth_fault(throws=(60.0, 50.0, 40.0), thickness=250.0)
    growth = sw.fault_growth(basin.section, basin.interpretation, basin.stratigraphy)
    sample = basin.section.dz
    ages = {layer.top: layer.age for layer in basin.stratigraphy.layers}
    for row in growth:
        thickness = row["footwall"] * row["expansion index"]
        np.testing.assert_allclose(thickness, row["hanging wall"])
        np.testing.assert_allclose(
            row["hanging wall"] - row["footwall"], row["slip gained"] * np.sin(np.deg2rad(60)), atol=sample
        )
        assert row["expansion index"] > 1
        if row["younger"] in ages and row["older"] in ages:
            np.testing.assert_allclose(
                row["slip rate"] * (ages[row["older"]] - ages[row["younger"]]), row["slip gained"]
            )


def test_extension_undone_by_each_step_adds_up_to_the_whole():
    case = sw.synthetic.graben()
    history = sw.extension_history(unfaulted(case), case.interpretation)
    np.testing.assert_allclose(
        history.column("extension since")[1],
        sum(sw.heave(f, case.interpretation.horizons[0]) for f in case.interpretation.faults),
        rtol=1e-4,
    )
    np.testing.assert_allclose(np.diff(history.column("width")), -history.column("extension since")[1], rtol=1e-9)


def test_a_grain_is_buried_by_what_lies_above_it():
    basin = sw.synthetic.growth_fault()
    top = next(layer.top for layer in basin.stratigraphy.layers if layer.top)
    horizon = basin.interpretation.horizon(top)
    x, z = horizon.pieces[0][0] + (1000.0, 0.0)
    restored = sw.Restoration(basin.section).strip(horizon)
    history = sw.burial_history(restored, (x, z + 300))
    np.testing.assert_allclose(history.column("burial"), [z + 300 - basin.section.z[0], 300], atol=1e-6)
    removed = sw.burial_history(restored, (x, z - 50))
    assert removed.column("burial")[1] is None


@pytest.mark.parametrize("point", [[(1, 2), (3, 4)], [(1e6, 0)]])
def test_a_history_of_burial_is_that_of_one_point_of_the_section(point):
    case = sw.synthetic.planar_fault()
    with pytest.raises((sw.SettingError, sw.PickError), match=r"one point|outside the section"):
        sw.burial_history(sw.Restoration(case.section), point)


def test_tables_print_with_units():
    table = sw.fault_throws(sw.synthetic.planar_fault().section, sw.synthetic.planar_fault().interpretation)
    assert "throw (m)" in str(table).splitlines()[1]
    assert len(str(table).splitlines()) == 2 + len(table)
    assert '<th scope="col">heave (m)</th>' in table._repr_html_()


def test_figures_have_a_line_for_each_fault_and_units():
    case = sw.synthetic.graben()
    ax = sw.plot.throws(sw.fault_throws(case.section, case.interpretation))
    assert [line.get_label() for line in ax.get_lines()][:2] == [fault.name for fault in case.interpretation.faults]
    assert ax.get_xlabel() == "Throw (m)"
    with pytest.raises(sw.SettingError, match="no horizon has an age"):
        sw.plot.throws(sw.fault_throws(case.section, case.interpretation), against="age")
    with pytest.raises(sw.SettingError, match="against must be"):
        sw.plot.throws(sw.fault_throws(case.section, case.interpretation), against="time")
    burial = sw.plot.burial(sw.burial_history(unfaulted(case), (2000, 1500)))
    assert burial.get_ylabel() == "Depth of burial (m)"


def test_rock_that_expands_by_decompaction_is_no_finding():
    basin = sw.synthetic.compacted_basin()
    restored = sw.Restoration(basin.section).decompact(basin.stratigraphy, basin.interpretation)
    balance = sw.balance(restored, basin.interpretation)
    assert not [finding for finding in balance.findings if finding.kind == "area"]
