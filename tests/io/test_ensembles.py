try:
    import resource
except ImportError:  # Windows
    resource = None

import numpy as np
import pytest
import xarray

import seiswidgets as sw
from tests.executors import InThisThread

UNCERTAINTY = sw.Uncertainty(horizon=1, dip=1)


def run(members=6, plan=None, uncertainty=UNCERTAINTY, **choices):
    case = sw.synthetic.planar_fault(throw=100, horizons=(1000.0,))
    plan = plan or sw.Plan(steps=())
    return sw.ensemble(case.section, case.interpretation, plan, uncertainty, members, **choices)


def test_an_ensemble_goes_through_netcdf(tmp_path):
    case = sw.synthetic.faulted_fold()
    plan = sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=400)
    uncertainty = sw.Uncertainty(horizon=1, correlation_length=5000)
    ensemble = sw.ensemble(case.section, case.interpretation, plan, uncertainty, 2, executor=InThisThread())
    data = sw.to_xarray(ensemble)
    data.to_netcdf(tmp_path / "ensemble.nc")
    again = xarray.load_dataset(tmp_path / "ensemble.nc")
    xarray.testing.assert_identical(data.astype(object), again.astype(object))
    throws = [ensemble.percentiles()["throw", f"H{index} at F1"] for index in (1, 2, 3)]
    np.testing.assert_array_equal(again["throw_percentile"].T, throws)
    assert again["throw"].attrs["units"] == "m"
    np.testing.assert_array_equal(again["area_ratio"].mean("member"), ensemble.ratio_mean)
    assert again["restored_depth"].sel(horizon="H2", member=1).shape == (101,)


def test_a_horizon_that_was_removed_has_no_values(tmp_path):
    """Stripping to the second horizon removes the first one, whose depths and lengths are unknown then."""
    case = sw.synthetic.faulted_fold()
    plan = sw.Plan((sw.Step("unfault"), sw.Step("strip", ("H2",))), fixed=case.fixed, spacing=400)
    uncertainty = sw.Uncertainty(horizon=1, correlation_length=5000)
    ensemble = sw.ensemble(case.section, case.interpretation, plan, uncertainty, 2, executor=InThisThread())
    data = sw.to_xarray(ensemble)
    assert data["horizon"].values.tolist() == ["H1", "H2", "H3"]
    for name in ("extension", "extension_percentile"):
        assert np.isnan(data[name].sel(horizon="H1")).all()
        assert np.isfinite(data[name].sel(horizon="H3")).all()
    np.testing.assert_array_equal(
        data["bed_length"].sel(horizon="H2"), ensemble.values[:, ensemble.labels.index(("bed length", "H2"))]
    )


def test_a_file_of_another_version_is_refused(tmp_path):
    path = tmp_path / "run.part"
    run(partial=path)
    _, _, rest = path.read_bytes().partition(b"ensemble")
    path.write_bytes(b"seiswidgets 0.0.1 ensemble" + rest)
    with pytest.raises(sw.DataError, match="the version of seiswidgets differ"):
        run(partial=path)


def test_a_run_continues_where_the_last_one_stopped(tmp_path):
    path = tmp_path / "run.part"

    def cancel_after_three(done, members):
        return done < 3

    with pytest.raises(sw.Cancelled, match="after 3 of 6 members"):
        run(partial=path, progress=cancel_after_three)
    counts = []
    whole = run(partial=path, progress=lambda done, members: counts.append(done))
    assert counts[0] == 4
    np.testing.assert_array_equal(whole.values, run().values)
    assert len(run(8, partial=path).members) == 8
    assert len(run(2, partial=path).members) == 2


@pytest.mark.parametrize("cut", [1, 20, 400])
def test_a_record_that_a_crash_cut_short_is_done_again(tmp_path, cut):
    path = tmp_path / "run.part"
    whole = run(partial=path)
    path.write_bytes(path.read_bytes()[:-cut])
    counts = []
    again = run(partial=path, progress=lambda done, members: counts.append(done))
    assert counts == [6]
    np.testing.assert_array_equal(again.values, whole.values)


def test_a_file_of_another_ensemble_is_refused_and_kept(tmp_path):
    path = tmp_path / "run.part"
    run(partial=path)
    before = path.read_bytes()
    for other in ({"seed": 1}, {"uncertainty": sw.Uncertainty(horizon=2)}, {"plan": sw.Plan(steps=(), spacing=90)}):
        with pytest.raises(sw.DataError, match="does not hold members of this ensemble"):
            run(partial=path, **other)
    assert path.read_bytes() == before


@pytest.mark.skipif(resource is None, reason="the limit stands for a full disk")
def test_a_full_disk_keeps_what_was_done(tmp_path):
    path = tmp_path / "run.part"
    run(3, partial=path)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 400, limits[1]))  # within the fourth record
    try:
        with pytest.raises(sw.DataError, match=r"run.part cannot grow: .*; free some space and run again"):
            run(partial=path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    counts = []
    whole = run(partial=path, progress=lambda done, members: counts.append(done))
    assert counts == [4, 5, 6]
    np.testing.assert_array_equal(whole.values, run().values)


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(sw.DataError, match=r"run.part cannot be written: No such file"):
        run(partial=tmp_path / "none" / "run.part")
