# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import meshes
import pytest
import seamwire_core as sw


@pytest.fixture(scope="session")
def surface() -> sw.Surface:
    return sw.Surface(*meshes.torus(40, 24))


@pytest.fixture(scope="session")
def curvature(surface: sw.Surface) -> sw.Curvature:
    return sw.principal_curvatures(surface)


@pytest.fixture(scope="session")
def metric(surface: sw.Surface, curvature: sw.Curvature) -> sw.Metric:
    """Strong enough for its embedding to be refined."""
    return sw.feature_metric(surface, curvature, follow="max", max_anisotropy=15)


@pytest.fixture(scope="session")
def embedding(surface: sw.Surface, metric: sw.Metric) -> sw.Embedding:
    return sw.embed(surface, metric, max_error=0)


@pytest.fixture(scope="session")
def field(embedding: sw.Embedding) -> sw.DistanceField:
    return sw.distance_field(embedding, 3)


@pytest.fixture(scope="session")
def large() -> sw.Surface:
    """A surface on which long work is long."""
    return sw.Surface(*meshes.torus(220, 160))


@pytest.fixture(scope="session")
def large_metric(large: sw.Surface) -> sw.Metric:
    return sw.feature_metric(large, sw.principal_curvatures(large))
