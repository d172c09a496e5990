import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.crossings import crossing_findings


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.planar_fault()


def test_horizons_that_cross_are_found_where_they_do(case):
    level = sw.Horizon([(0.0, 600.0), (1500.0, 600.0)], name="A")
    steep = sw.Horizon([(200.0, 500.0), (600.0, 900.0)], name="B")
    apart = sw.Horizon([(0.0, 700.0), (250.0, 700.0)], name="C")
    (finding,) = crossing_findings(case.section, [level, steep, apart])
    assert (finding.severity, finding.kind, finding.pick) == ("warning", "crossing", "B")
    assert finding.where == pytest.approx((300, 600))
    assert "horizon 'B' crosses horizon 'A' near x=300 m, z=600 m" in finding.text


def test_a_horizon_that_ends_at_another_does_not_cross_it(case):
    level = sw.Horizon([(0.0, 600.0), (1500.0, 600.0)], name="A")
    for overshoot in (-5.0, 0.0, 5.0):
        truncated = sw.Horizon([(200.0, 800.0), (400.0, 600.0 - overshoot)], name="B")
        assert crossing_findings(case.section, [level, truncated]) == []


def test_a_restoration_reports_crossing_horizons(case):
    picks = case.interpretation
    left = picks.horizons[0].pieces[0]
    (x0, z0), (x1, _) = left[0], left[-1]
    crossing = sw.Horizon(np.array([(x0 + 0.2 * (x1 - x0), z0 - 100), (x0 + 0.6 * (x1 - x0), z0 + 100)]), name="X")
    restored = sw.Restoration(case.section, 200.0).unfault(picks.faults, [*picks.horizons, crossing])
    assert "crossing" in {finding.kind for finding in restored.findings}
