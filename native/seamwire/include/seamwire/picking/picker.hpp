// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire {

/// A pixel of a picture of an object.
struct Sight {
  Eigen::Matrix4d perspective = Eigen::Matrix4d::Identity();  ///< takes world coordinates to clip space
  Eigen::Matrix4d object = Eigen::Matrix4d::Identity();       ///< takes object coordinates to world coordinates
  Eigen::Vector2d size = Eigen::Vector2d::Ones();             ///< of the picture, in pixels
  Eigen::Vector2d cursor = Eigen::Vector2d::Zero();           ///< in pixels from the bottom left
  std::vector<Eigen::Vector4d> clip_planes;  ///< in world coordinates. Their negative side is not shown.
  double scale = 1.0;                        ///< of the display: distances in pixels are multiplied by it
  bool xray = false;                         ///< whether to find what lies behind faces too
};

/// Straight pieces of curves that a pick may find.
struct PickLayer {
  std::vector<Vector> ends;          ///< two for each piece, twice the same for a point
  std::vector<std::int32_t> owners;  ///< the number of each piece's curve; of a crest line, the piece's triangle
  double reach = 0.0;                ///< pixels beside a piece in which it is found
  std::vector<Edge> vertices{};      ///< of crest lines, for each piece: the vertices nearest to its ends
};

/// What a pick may find besides the mesh.
struct PickTargets {
  std::vector<PickLayer> layers;
  std::vector<double> strengths;  ///< how strong the feature is at each vertex, or nothing
  double least_strength = std::numeric_limits<double>::infinity();  ///< only vertices above this are features
  std::vector<std::int32_t> preferred;                              ///< vertices, ascending
};

/// What a pick looks for.
struct PickOptions {
  std::vector<std::int32_t> layers;  ///< before the mesh, in this order
  bool layers_only = false;
  bool surface_only = false;   ///< only the point of the surface
  bool vertices_only = false;  ///< of the plain mesh, vertices alone
  bool edges_only = false;     ///< of the plain mesh, edges alone, with the edge that crosses them
  bool anywhere = false;       ///< the point of the surface, if no vertex is meant
  bool preferred = false;      ///< preferred vertices before others
  bool features = false;       ///< corners, and otherwise the strongest feature nearby
  std::int32_t crests = -1;    ///< the layer of crest lines, if they are looked for
};

/// What is under the cursor: a vertex, an edge, or, without both, a place.
struct Picked {
  std::int32_t layer = -1;  ///< -1 for the mesh
  std::int32_t owner = -1;  ///< of the piece
  std::int32_t vertex = -1;
  Edge edge{-1, -1};
  std::int32_t triangle = -1;     ///< where the place is, or the cursor if only edges are looked for
  Vector place = Vector::Zero();  ///< in the coordinates of the points
  double depth = 0.0;             ///< of a piece or the surface: from the near plane, in world units
  bool is_feature = false;
  Edge crossing{-1, -1};       ///< the edge that crosses `edge` at its end nearer to the cursor
  bool is_close_call = false;  ///< whether one of these edges is too short on the screen to point at
  bool is_inside = false;      ///< whether the cursor is inside a face, away from `edge`
};

/// Finds what is under the cursor on a mesh.
///
/// Separate threads build its tables. A query before they are built waits for them. Several threads may use it at once.
class SEAMWIRE_API Picker {
 public:
  /// Start to build the tables, and return at once.
  ///
  /// \param points coordinates
  /// \param triangles vertex numbers in [0, points.size())
  /// \param polygons the polygon of each triangle. Triangles of a polygon follow one another.
  /// \param edges the edges of the polygons, without diagonals, and edges without a polygon
  /// \param to_object takes points to object coordinates
  /// \throws InvalidInput if a vertex is out of range, or the numbers of triangles and polygons differ
  Picker(std::vector<Vector> points, std::vector<Triangle> triangles, std::vector<std::int32_t> polygons,
         std::vector<Edge> edges, const Eigen::Matrix3d& to_object = Eigen::Matrix3d::Identity());

  /// Return whether the tables are built.
  bool ready() const;
  /// Wait until the tables are built.
  void wait() const;
  /// Find what is under the cursor.
  ///
  /// \throws InvalidInput if there are not two ends for each piece, or not as many strengths as vertices, or if a
  /// vertex
  ///   beside a crest is out of range
  std::optional<Picked> pick(const Sight& sight, const PickTargets& targets, const PickOptions& options) const;

 private:
  struct Parts;  // picker.cpp
  std::shared_ptr<const Parts> parts_;
};

}  // namespace seamwire
