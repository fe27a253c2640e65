// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

#include "detail/index.hpp"
#include "files/bytes.hpp"
#include "files/formats.hpp"
#include "files/text_lines.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/files/mesh_file.hpp"
#include "seamwire/surface/triangulate.hpp"

namespace seamwire::detail {
namespace {

constexpr std::size_t kHeader = 80, kTriangle = 50;

struct HashOfPoint {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p) hash = hash * 1000003 + std::hash<double>{}(x);
    return hash;
  }
};

/// Collects triangles, whose corners at the same place become one vertex.
class Corners {
 public:
  void add(double x, double y, double z) {
    // -0 and 0 are the same place.
    const auto [at, is_new] =
        vertices_.try_emplace({x + 0.0, y + 0.0, z + 0.0}, static_cast<std::int32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.emplace_back(x, y, z);
    mesh_.corners.push_back(at->second);
  }

  PolygonMesh mesh() && {
    mesh_.sizes.assign(mesh_.corners.size() / 3, 3);
    return std::move(mesh_);
  }

 private:
  PolygonMesh mesh_;
  std::unordered_map<std::array<double, 3>, std::int32_t, HashOfPoint> vertices_;
};

std::string lower(std::string_view word) {
  std::string own(word);
  for (char& c : own) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return own;
}

bool begins_with_solid(std::string_view file) {
  const std::size_t begin = file.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && lower(file.substr(begin, 5)) == "solid";
}

PolygonMesh read_text(const std::string& name, std::string_view file) {
  TextLines lines(name, file, TextSyntax::kWords);
  Corners corners;
  std::size_t in_loop = 0;
  bool ended = false;
  while (lines.next()) {
    const std::string kind = lower(lines.words().front());
    if (kind == "vertex") {
      const std::vector<double>& given = lines.numbers(1, 3);
      if (++in_loop > 3) lines.fail("a facet has more than 3 corners");
      corners.add(given[0], given[1], given[2]);
    } else if (kind == "endloop") {
      if (in_loop != 3) lines.fail("a facet has " + std::to_string(in_loop) + " corners instead of 3");
      in_loop = 0;
    } else if (kind == "endsolid") {
      ended = true;
    } else if (kind != "solid" && kind != "facet" && kind != "outer" && kind != "endfacet") {
      lines.fail("'" + kind + "' does not belong into an STL file");
    }
  }
  if (in_loop != 0 || !ended) throw FileError(name + ": the file ends before endsolid");
  return std::move(corners).mesh();
}

/// A coordinate in the precision of the file. Throws InvalidInput if it is too large for that.
float single(double x) {
  if (std::abs(x) > std::numeric_limits<float>::max()) {
    throw InvalidInput("points: a coordinate is too large for single precision, which STL files have");
  }
  return static_cast<float>(x);
}

}  // namespace

PolygonMesh read_stl(const std::string& name, std::string_view file) {
  // Binary files may begin with "solid" too. The number at that place of a text is larger than any file has room for.
  const std::size_t start = kHeader + sizeof(std::uint32_t);
  const std::size_t count =
      file.size() < start ? 0 : number_at<std::uint32_t>(file.data() + kHeader, std::endian::little);
  if (file.size() < start + count * kTriangle) {
    if (begins_with_solid(file)) return read_text(name, file);
    if (file.size() < start)
      throw FileError(name + ": the file ends within its first " + std::to_string(start) + " bytes");
    throw FileError(name + ": the file ends within triangle " + std::to_string((file.size() - start) / kTriangle) +
                    " of " + std::to_string(count));
  }
  Corners corners;
  for (std::size_t t = 0; t < count; ++t) {
    const char* triangle = file.data() + start + t * kTriangle + 3 * sizeof(float);  // after the normal
    for (int i = 0; i < 3; ++i) {
      std::array<double, 3> p{};
      for (double& x : p) {
        x = number_at<float>(triangle, std::endian::little);
        triangle += sizeof(float);
        if (!std::isfinite(x))
          throw FileError(name + ", triangle " + std::to_string(t) + ": a coordinate is not finite");
      }
      corners.add(p[0], p[1], p[2]);
    }
  }
  return std::move(corners).mesh();
}

std::string write_stl(const PolygonMesh& mesh) {
  const Triangulation cut = triangulate(mesh.points, mesh.corners, mesh.sizes);
  std::string bytes = "binary STL";
  bytes.resize(kHeader, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(cut.triangles.size()));
  for (const Triangle& triangle : cut.triangles) {
    const auto at = [&](std::size_t i) -> const Vector& { return mesh.points[index(triangle[i])]; };
    const Vector normal = (at(1) - at(0)).stableNormalized().cross((at(2) - at(0)).stableNormalized()).normalized();
    for (const Vector& p : {normal, at(0), at(1), at(2)}) {
      for (const double x : p) append_bytes(bytes, single(x));
    }
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace seamwire::detail
