import os
import sys
from concurrent.futures import Executor, ThreadPoolExecutor

import numpy as np
import psutil
import pytest

import seiswidgets as sw
from seiswidgets.geology.parallel import Lost, run_tasks
from tests.executors import InThisThread, number_or_death, resource_trackers

MEMBERS = 6
pytestmark = pytest.mark.skipif(sys.modules.get("triangle", "") is None, reason="processes would use Triangle")


@pytest.fixture(scope="module", autouse=True)
def trackers():
    with resource_trackers():
        yield


def run(members=MEMBERS, **choices):
    case = sw.synthetic.planar_fault(throw=100, horizons=(1000.0,))
    plan = sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=400)
    uncertainty = sw.Uncertainty(horizon=1, fault=1, correlation_length=2000)
    return sw.ensemble(case.section, case.interpretation, plan, uncertainty, members, **choices)


@pytest.fixture(scope="module")
def alone():
    return run(executor=InThisThread())


def same(one, other):
    return all(
        np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True) for name in ("values", "ratios")
    )


@pytest.mark.parametrize("workers", [1, 2, 4])
def test_the_number_of_workers_changes_nothing(alone, workers):
    assert same(run(workers=workers), alone)


@pytest.fixture
def cluster(tmp_path, monkeypatch):
    """A Dask cluster of two processes of this computer, which leaves no thread and no folder behind."""
    import dask
    import distributed

    choices = {"n_workers": 2, "threads_per_worker": 1, "host": "127.0.0.1", "dashboard_address": None}
    with (
        ThreadPoolExecutor(1) as threads,
        dask.config.set({"temporary-directory": str(tmp_path)}),
    ):
        monkeypatch.setattr("distributed.utils._offload_executor", threads)
        with distributed.LocalCluster(**choices) as cluster, distributed.Client(cluster) as client:
            yield client


def test_a_cluster_changes_nothing(alone, cluster):
    with cluster.get_executor() as executor:
        assert same(run(executor=executor), alone)


def is_worker(process):
    try:
        return "loky.backend.popen_loky_posix" in process.cmdline()
    except psutil.NoSuchProcess:  # it has just ended, for another test perhaps
        return False


def test_killing_a_worker_in_the_middle_changes_nothing(alone):
    killed = []

    def kill_one(done, members):
        if done == 1 and not killed:
            killed.append(next(child for child in psutil.Process().children() if is_worker(child)))
            killed[0].kill()

    assert same(run(workers=2, progress=kill_one), alone)
    assert killed


def test_a_worker_that_dies_costs_its_tasks_only(tmp_path):
    flags = {index: str(tmp_path / str(index)) for index in (3, 7)}
    for flag in flags.values():
        open(flag, "w").close()
    results = [one for one in run_tasks(number_or_death, flags, range(10), workers=2) if one]
    assert sorted(results) == [(index, index**2) for index in range(10)]
    assert not os.listdir(tmp_path)


def test_a_task_that_always_kills_its_worker_is_given_up():
    results = dict(one for one in run_tasks(number_or_death, {4: "always"}, range(8), workers=2) if one)
    assert isinstance(results.pop(4), Lost)
    assert results == {index: index**2 for index in range(8) if index != 4}


def test_an_executor_that_fails_is_tried_three_times():
    class Failing(Executor):
        tried = 0

        def submit(self, function, *arguments):
            Failing.tried += 1
            return ThreadPoolExecutor.submit(threads, divmod, 1, 0)

    with ThreadPoolExecutor(1) as threads:
        ((index, lost),) = [one for one in run_tasks(number_or_death, {}, [5], Failing()) if one]
    assert (index, Failing.tried) == (5, 3)
    assert "its worker was lost 3 times" in str(lost)


def test_an_executor_that_is_shut_down():
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.raises(
        sw.SettingError, match=r"the executor takes no tasks .*; give one that is running, or leave it out"
    ):
        run(executor=executor)


@pytest.mark.parametrize("executor", [2, "processes"])
def test_what_is_no_executor(executor):
    with pytest.raises(sw.SettingError, match=r"executor must be a concurrent.futures.Executor, but is a"):
        run(executor=executor)


def test_cancelling_ends_the_processes(caplog):
    with pytest.raises(sw.Cancelled, match="after 1 of 6 members"):
        run(workers=1, progress=lambda done, members: done < 1)
    assert not caplog.records
