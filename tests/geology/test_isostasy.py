"""The crust under a changed load, and rock that was eroded."""

import numpy as np
import pytest

import seiswidgets as sw

LAYERS = sw.Stratigraphy([sw.Layer(None, 0, "sand"), sw.Layer("H1", 5, "shale"), sw.Layer("H2", 9, "chalk")])
AIRY = sw.Isostasy(sea_level=None)


def level_case():
    section = sw.Section(np.random.default_rng(0).standard_normal((101, 81)), dx=50.0, dz=20.0)
    horizons = [sw.Horizon([(0, z), (4000, z)], name=name) for name, z in (("H1", 300), ("H2", 900))]
    return section, sw.Interpretation([], horizons)


@pytest.mark.parametrize("wavelength", [2e3, 2e4, 2e5, 2e6])
def test_a_sinusoidal_load_sinks_as_the_plate_equation_says(wavelength):
    plate = sw.Isostasy(elastic_thickness=10e3)
    step = wavelength / 400
    x = (np.arange(800) + 0.5) * step
    load = 1e7 * np.cos(2 * np.pi * x / wavelength)
    rigidity = 7e10 * 10e3**3 / (12 * (1 - 0.25**2))
    exact = load / ((3300 - 1030) * 9.81 + rigidity * (2 * np.pi / wavelength) ** 4)
    assert np.allclose(plate.deflection(load, step), exact, rtol=0, atol=1e-3 * np.abs(exact).max())


def test_airy_is_the_limit_of_a_thin_plate():
    load = np.random.default_rng(1).uniform(0, 1e7, 200)
    thin = sw.Isostasy(elastic_thickness=0.1).deflection(load, 500.0)
    airy = sw.Isostasy().deflection(load, 500.0)
    assert np.allclose(airy, load / ((3300 - 1030) * 9.81))
    assert np.allclose(thin, airy, rtol=1e-5)


def test_the_load_beyond_the_section_counts():
    plate, load = sw.Isostasy(elastic_thickness=10e3), np.full(100, 1e7)
    whole = 1e7 / plate.restoring
    assert np.allclose(plate.deflection(load, 100.0, "constant"), whole, rtol=1e-6)
    assert plate.deflection(load, 100.0, "zero").max() < 0.2 * whole
    with pytest.raises(sw.SettingError, match="beyond must be 'mirror', 'constant', 'zero', but is 'none'"):
        plate.deflection(load, 100.0, "none")


def test_stripping_lets_the_crust_rise_by_the_weight_that_is_gone():
    section, picks = level_case()
    stripped = sw.Restoration(section).strip(picks.horizon("H1"))
    risen = stripped.isostasy(AIRY, LAYERS, picks)
    depth = np.linspace(0, 300, 100_001)
    weight = np.trapezoid(sw.LITHOLOGIES["sand"].density(depth), depth)
    moved = risen.stages[-1].vertices - risen.stages[-1].mesh.vertices
    assert np.allclose(moved, [0, -weight / 3300], atol=1e-4)
    assert "rise of the crust" in dict(risen.stages[-1].report.details)
    under_water = stripped.isostasy(sw.Isostasy(), LAYERS, picks)
    shift = under_water.stages[-1].vertices - under_water.stages[-1].mesh.vertices
    assert np.allclose(shift[:, 1], -(weight - 1030 * 300) / (3300 - 1030), atol=1e-4)


def test_expansion_weighs_nothing_but_the_water_that_enters_the_pores():
    section, picks = level_case()
    start = sw.Restoration(section).strip(picks.horizon("H1"))
    heavier = start.decompact(LAYERS, picks).isostasy(AIRY, LAYERS, picks)
    lighter = start.isostasy(AIRY, LAYERS, picks)
    grown = -np.ptp(heavier.stages[1].vertices[:, 1]) + np.ptp(heavier.stages[1].mesh.vertices[:, 1])
    shift = [
        np.mean(stage.vertices[:, 1] - stage.mesh.vertices[:, 1]) for stage in (heavier.stages[-1], lighter.stages[-1])
    ]
    assert shift[0] - shift[1] == pytest.approx(-grown * 1030 / 3300, rel=1e-3)


def test_rock_that_was_buried_deeper_does_not_expand():
    section, picks = level_case()
    start = sw.Restoration(section).strip(picks.horizon("H1"))
    put_back = start.unerode(-500.0)
    assert put_back.stages[-1].outline.area == pytest.approx(4000 * 2500)
    assert np.isnan(put_back.section.amplitude[put_back.section.z < 280]).all()
    still = put_back.decompact(LAYERS, picks).stages[-1]
    assert np.allclose(still.vertices, still.mesh.vertices, atol=1e-6)
    loose = start.decompact(LAYERS, picks)
    looser = put_back.strip(picks.horizon("H1")).decompact(LAYERS, picks)
    assert looser.stages[-1].outline.area > 1.02 * loose.stages[-1].outline.area


def test_a_surface_below_the_rock_puts_nothing_back():
    section, _ = level_case()
    with pytest.raises(sw.SettingError, match="nowhere above the rock"):
        sw.Restoration(section).unerode(500.0)
