import meshio
import numpy as np
import pytest

import seiswidgets as sw
from tests.io.restored import restored


@pytest.mark.parametrize("suffix", [".vtu", ".vtk"])
@pytest.mark.parametrize("stage", [0, -1])
def test_a_mesh_opens_again_with_the_same_numbers(tmp_path, suffix, stage):
    path, made = tmp_path / f"mesh{suffix}", restored(True).stages[stage]
    sw.save_mesh(restored(True), path, stage)
    mesh = meshio.read(path)
    np.testing.assert_array_equal(
        mesh.points, np.column_stack([made.mesh.vertices * (1, -1), np.zeros(len(mesh.points))])
    )
    np.testing.assert_array_equal(mesh.cells_dict["triangle"], made.mesh.triangles)
    restored_points = (mesh.points + mesh.point_data["displacement"])[:, :2] * (1, -1)
    np.testing.assert_allclose(restored_points, made.vertices, atol=1e-9)
    np.testing.assert_array_equal(mesh.cell_data["area_ratio"][0], made.area_ratio)
    stretches = [mesh.cell_data[f"{name}_stretch"][0] for name in ("larger", "smaller")]
    np.testing.assert_array_equal(np.transpose(stretches), made.principal_stretches)


def test_a_stage_or_an_ending_that_is_none(tmp_path):
    with pytest.raises(sw.SettingError, match=r"no stage 2 to save; there are 2, counted from 0"):
        sw.save_mesh(restored(), tmp_path / "mesh.vtu", 2)
    with pytest.raises(sw.SettingError, match=r"mesh.obj must end in .vtu or .vtk"):
        sw.save_mesh(restored(), tmp_path / "mesh.obj")
