"""Bodies are holes in the mesh: nothing inside them moves, their area is reported, and lines end at them."""

import numpy as np
import pytest
import shapely

import seiswidgets as sw


def ellipse(x, z, half_width, half_height):
    turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return np.column_stack([x + half_width * np.cos(turn), z + half_height * np.sin(turn)])


SALT = sw.Body(ellipse(900, 1350, 250, 330), name="S1")  # beside the fault
ON_FAULT = sw.Body(ellipse(2320, 950, 150, 120), name="S2")  # with the cut-offs of H2
AT_TOP = sw.Body([(3300, 0), (3800, 0), (3700, 500), (3400, 450)], kind="no data", name="N1")
AT_BASE = sw.Body(ellipse(1500, 2000, 150, 300), name="S3")  # sticks out of the section
EVERY = SALT, ON_FAULT, AT_TOP, AT_BASE


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.faulted_fold()


@pytest.fixture(scope="module")
def restored(case):
    picks = sw.Interpretation(case.interpretation.faults, case.interpretation.horizons, EVERY)
    return sw.Plan((sw.Step("unfault"), sw.Step("flatten", "H2")), spacing=90, fixed=case.fixed).restore(
        case.section, picks
    )


def test_a_restoration_around_bodies_settles_and_is_right(case, restored):
    unfaulted, flattened = restored.stages
    assert restored.settled
    assert unfaulted.report.iterations <= 6
    middle = unfaulted.mesh.vertices[unfaulted.mesh.triangles].mean(axis=1)
    moved = unfaulted.vertices[unfaulted.mesh.triangles].mean(axis=1)
    near_fault = shapely.LineString(case.interpretation.faults[0].points).distance(shapely.points(middle)) < 20
    off = np.hypot(*(moved - case.to_unfaulted(middle))[~near_fault].T)
    assert off.max() < 0.5
    assert flattened.report.beds[0].flatness < 0.1 * case.section.dz


def test_the_mesh_leaves_bodies_out(restored):
    mesh = restored.stages[0].mesh
    triangles = shapely.polygons(mesh.vertices[mesh.triangles])
    for body in EVERY:
        covered = shapely.intersection(triangles, shapely.Polygon(body.points).buffer(-1))
        assert shapely.area(covered).sum() < 1e-3 * shapely.Polygon(body.points).area


def test_inside_a_body_nothing_is_restored(restored):
    inside = [(900.0, 1350.0), (2320.0, 950.0), (3550.0, 200.0), (1500.0, 1950.0)]
    assert np.isnan(restored.to_restored(inside)).all()
    (border,) = restored.carried(SALT)
    section, (x, z) = restored.section, border.mean(axis=0)
    assert np.isnan(section.amplitude[round((z - section.z0) / section.dz), round((x - section.x0) / section.dx)])


def test_areas_are_reported(case, restored):
    box = shapely.box(0, 0, 4000, 2000)
    first, second = (stage.report for stage in restored.stages)
    for body, area, after in zip(EVERY, first.bodies, second.bodies, strict=True):
        assert area.body == body.name
        assert area.before == pytest.approx(shapely.Polygon(body.points).intersection(box).area)
        assert after.before == pytest.approx(area.after, rel=1e-3)
        assert sum(shapely.Polygon(ring).area for ring in restored.carried(body)) == pytest.approx(
            after.after, rel=1e-3
        )
        if body is not ON_FAULT:  # its block moved rigidly
            assert area.after == pytest.approx(area.before, rel=1e-3)
    assert "body S1" in dict(first.rows())


def test_holes_are_no_gaps(restored):
    for stage in restored.stages:
        assert stage.report.gap < 10
        assert not [finding for finding in stage.report.findings if finding.kind == "gap"]


def test_a_cutoff_inside_a_body_is_none(restored):
    report = restored.stages[0].report
    assert {cutoff.horizon for cutoff in report.cutoffs} == {"H1", "H3"}
    assert {finding.kind for finding in report.findings if finding.pick == "H2"} == {"one-sided"}


def test_another_body_is_another_job(case):
    jobs = [
        sw.Interpretation(case.interpretation.faults, case.interpretation.horizons, bodies) for bodies in ((), (SALT,))
    ]
    plan = sw.Plan((sw.Step("unfault"),), spacing=150)
    first, second = (plan.restore(case.section, picks).stages[0].mesh for picks in jobs)
    assert second.areas.sum() == pytest.approx(first.areas.sum() - shapely.Polygon(SALT.points).area)
    assert sw.check(case.section, jobs[1], plan) == []


@pytest.mark.parametrize(
    ("points", "keywords", "message"),
    [
        ([(0, 0), (1, 1)], {}, "body 'body' needs at least three different points"),
        ([(0, 0), (1, 1), (0, 1), (1, 0)], {"name": "S"}, "the border of body 'S', from x=0, z=0, crosses itself"),
        ([(0, 0), (1, 0), (np.nan, 1)], {}, "finite points"),
        ("salt", {}, "must be a list of points"),
        ([(0, 0), (1, 0), (0, 1)], {"kind": "clay"}, "kind of body 'body' must be 'salt' or 'no data', but is 'clay'"),
    ],
)
def test_unusable_bodies_are_refused(points, keywords, message):
    with pytest.raises(sw.SeiswidgetsError, match=message):
        sw.Body(points, **keywords)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (
            [(9000, 0), (9100, 0), (9000, 90)],
            "body 'B' covers less than 4 samples .* reaches from x=0",
        ),
        ([(-10, -10), (4010, -10), (4010, 2010), (-10, 2010)], "no rock is left beside the bodies"),
    ],
)
def test_bodies_must_leave_rock_and_lie_in_the_section(case, points, message):
    restoration = sw.Restoration(case.section, bodies=[sw.Body(points, name="B")])
    with pytest.raises(sw.PickError, match=message) as error:
        restoration.flatten(case.interpretation.horizons[0])
    assert error.value.pick == "B"


def test_bodies_have_names_of_their_own():
    with pytest.raises(sw.PickError, match="two bodies are called 'S1'"):
        sw.Interpretation(bodies=[SALT, SALT])
