"""Athy's law, and layers in order."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.lithology import PER_KM, pore_thickness, thickness_at


@pytest.mark.parametrize("name", sw.LITHOLOGIES)
def test_expanding_and_compacting_again_is_the_identity(name):
    rock, rng = sw.LITHOLOGIES[name], np.random.default_rng(0)
    phi0, c = np.full(200, rock.phi0), np.full(200, rock.c * PER_KM)
    top, length, shallow = rng.uniform(0, 6000, 200), rng.uniform(0, 2000, 200), rng.uniform(0, 3000, 200)
    solid = length - pore_thickness(phi0, c, top, top + length, length)
    loose = thickness_at(phi0, c, solid, shallow)
    solid_again = loose - pore_thickness(phi0, c, shallow, shallow + loose, loose)
    assert np.allclose(thickness_at(phi0, c, solid_again, top), length, rtol=0, atol=1e-9)


def test_pores_are_the_integral_of_the_porosity():
    shale = sw.LITHOLOGIES["shale"]
    depth = np.linspace(500, 1500, 200_001)
    pores = np.trapezoid(shale.porosity(depth), depth)
    exact = pore_thickness(*np.array([[shale.phi0], [shale.c * PER_KM], [500.0], [1500.0], [1000.0]]))
    assert exact[0] == pytest.approx(pores, abs=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"phi0": 1.2}, "porosity phi0 .* from 0 to below 1, but is 1.2"),
        ({"c": -0.1}, "c must be 0 per km or more"),
        ({"grain_density": 2.65}, "grain_density must be from 1000"),
        ({"phi0": "high"}, "phi0 must be a finite number"),
    ],
)
def test_a_lithology_out_of_range_is_refused(change, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.Lithology(**({"phi0": 0.5, "c": 0.4, "grain_density": 2650.0} | change))


@pytest.mark.parametrize(
    ("layers", "message"),
    [
        ([], "one seiswidgets.Layer or more"),
        ([sw.Layer(None, 5), sw.Layer("H1", 2)], "ages must rise from young to old, but 'H1' \\(2 Ma\\)"),
        ([sw.Layer(None, 0), sw.Layer(None, 2)], "layer 2 has no top"),
        ([sw.Layer("H1", 0), sw.Layer("H1", 2)], "two layers have the same top, 'H1'"),
    ],
)
def test_layers_out_of_order_are_refused(layers, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.Stratigraphy(layers)


def test_a_layer_checks_its_values():
    with pytest.raises(sw.SettingError, match="one of shale, sand"):
        sw.Layer("H1", 5, "granite wash")
    with pytest.raises(sw.SettingError, match="0 Ma or more"):
        sw.Layer("H1", -5)
    with pytest.raises(sw.SettingError, match="in the order of their x"):
        sw.Layer("H1", 5, water_depth=[(100, 5), (0, 5)])
