# SPDX-License-Identifier: GPL-3.0-or-later
"""Metrics as values, and their families."""

from __future__ import annotations

import numpy as np
import pytest
import seamwire_core as sw


def test_the_families_are_those_that_live_wires_know() -> None:
    families = {family.name: family for family in sw.metric_families()}
    assert list(families) == ["feature", "campen", "pottmann_kovacs", "concave", "euclidean"]
    assert [family.parameter for family in families.values()] == ["gamma", "alpha", "beta", "strength", None]
    assert [name for name, family in families.items() if family.has_directions] == [
        "feature",
        "campen",
        "pottmann_kovacs",
    ]
    assert families["campen"].least_parameter == 1.0


def test_specs_are_equal_exactly_if_their_values_are() -> None:
    one = sw.MetricSpec("feature", "min", max_anisotropy=20.0)
    assert one == sw.MetricSpec("feature", "min", max_anisotropy=20.0)
    assert hash(one) == hash(sw.MetricSpec("feature", "min", max_anisotropy=20.0))
    assert one != sw.MetricSpec("feature", "max", max_anisotropy=20.0)
    assert one != sw.MetricSpec("feature", "min", max_anisotropy=20.0, clamp_percentile=99.0)
    assert one != "feature"
    assert (one.family, one.follow, one.kind, one.parameter, one.max_anisotropy) == (
        "feature",
        "min",
        "min",
        None,
        20.0,
    )
    assert sw.MetricSpec("concave").kind == "concave"
    assert sw.MetricSpec("euclidean").follow is None


def test_they_make_the_metrics_of_the_functions(surface: sw.Surface, curvature: sw.Curvature) -> None:
    smoothed = sw.smoothed_curvatures(surface, curvature)
    for spec, expected in [
        (sw.MetricSpec("feature", "max", parameter=0.3), sw.feature_metric(surface, curvature, "max", gamma=0.3)),
        (sw.MetricSpec("campen", "min", parameter=4.0), sw.campen_metric(surface, curvature, "min", alpha=4.0)),
        (
            sw.MetricSpec("pottmann_kovacs", "min", max_anisotropy=5.0),
            sw.pottmann_kovacs_metric(surface, curvature, max_anisotropy=5.0),
        ),
        (sw.MetricSpec("concave", max_anisotropy=10.5), sw.concave_metric(surface, smoothed, 0.5)),
        (sw.MetricSpec("euclidean"), sw.euclidean_metric(surface, curvature)),
    ]:
        np.testing.assert_array_equal(sw.make_metric(surface, spec).tensors, expected.tensors)


@pytest.mark.parametrize(
    ("family", "options", "message"),
    [
        ("flat", {}, "metric: expected"),
        ("feature", {}, "needs a direction"),
        ("concave", {"follow": "min"}, "follows no direction"),
        ("euclidean", {"max_anisotropy": 2.0}, "has no strength"),
        ("campen", {"follow": "min", "parameter": 0.5}, "at least 1"),
        ("feature", {"follow": "up"}, "follow: expected"),
        ("feature", {"follow": "min", "clamp_percentile": 99.0}, "either its parameter or"),
    ],
)
def test_wrong_specs_are_refused(family: str, options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sw.MetricSpec(family, **options)


def test_making_one_can_be_cancelled(surface: sw.Surface) -> None:
    with pytest.raises(sw.Cancelled):
        sw.make_metric(surface, sw.MetricSpec("euclidean"), lambda _: False)


def test_a_metric_of_ones_own_is_that_of_its_tensors(surface: sw.Surface, curvature: sw.Curvature) -> None:
    made = sw.feature_metric(surface, curvature, max_anisotropy=20.0)
    own = sw.Metric(made.normals, made.tensors)
    np.testing.assert_array_equal(own.tensors, made.tensors)
    np.testing.assert_array_equal(own.normals, made.normals)
    np.testing.assert_array_equal(sw.embed(surface, own).lengths, sw.embed(surface, made).lengths)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda normals, tensors: (normals, tensors[1:]), "one for each normal"),
        (lambda normals, tensors: (normals, tensors[:, :2]), r"shape \(n, 3, 3\), got shape"),
        (lambda normals, tensors: (normals, -tensors), "at vertex 0"),
        (lambda normals, tensors: (normals, tensors + 0.1 * np.cross(normals[:, None], np.eye(3))), "not symmetric"),
        (lambda normals, tensors: (normals, tensors * np.nan), "vertex 0"),
        (lambda normals, tensors: (3 * normals, tensors), "neither a unit vector nor zero"),
        (lambda normals, tensors: (normals * np.nan, tensors), "neither a unit vector nor zero"),
        (lambda normals, tensors: (normals, tensors + np.eye(3)), "does not map the normal to zero"),
        (lambda normals, tensors: (normals, "none"), "tensors: expected real numbers"),
    ],
)
def test_wrong_tensors_are_refused(curvature: sw.Curvature, surface: sw.Surface, change: object, message: str) -> None:
    made = sw.euclidean_metric(surface, curvature)
    with pytest.raises(ValueError, match=message):
        sw.Metric(*change(made.normals, np.array(made.tensors)))
