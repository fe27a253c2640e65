// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include "detail/index.hpp"
#include "files/formats.hpp"
#include "files/text_lines.hpp"

namespace seamwire::detail {
namespace {

/// The data of each vertex, as the first word of the file names them: [ST][C][N]OFF.
struct Layout {
  bool texture = false, color = false, normal = false;
  std::string_view joined;  ///< the number of vertices, if it follows without a space
};

/// Reads the first word, if it is one of these. Throws FileError for points in other than three dimensions.
Layout layout_of(const TextLines& lines, std::string_view word) {
  Layout layout;
  const auto take = [&](std::string_view part) {
    if (!word.starts_with(part)) return false;
    word.remove_prefix(part.size());
    return true;
  };
  layout.texture = take("ST");
  layout.color = take("C");
  layout.normal = take("N");
  if (take("OFF") && (word.empty() || integer_from(word))) {
    layout.joined = word;
  } else {
    lines.fail("'" + std::string(lines.words().front()) + "' is not OFF, COFF, NOFF or the like");
  }
  return layout;
}

}  // namespace

PolygonMesh read_off(const std::string& name, std::string_view file) {
  TextLines lines(name, file, TextSyntax::kComments);
  lines.need("its first word");
  const Layout layout = layout_of(lines, lines.words().front());
  std::size_t first = layout.joined.empty() ? 1 : 0;
  if (first == 1 && lines.words().size() == 1) {
    lines.need("the numbers of vertices and faces");
    first = 0;
  } else if (first == 1 && lines.words()[1] == "BINARY") {
    lines.fail("binary OFF files cannot be read");
  }
  const std::int64_t vertices = layout.joined.empty() ? lines.integer(first) : *integer_from(layout.joined);
  const std::int64_t faces = lines.integer(first + 1);
  if (std::min(vertices, faces) < 0) lines.fail("a number of elements is negative");

  PolygonMesh mesh;
  const std::size_t before = layout.normal ? 6 : 3;
  for (std::int64_t v = 0; v < vertices; ++v) {
    lines.need("vertex " + std::to_string(v) + " of " + std::to_string(vertices));
    const std::vector<double>& given = lines.numbers(0, before + (layout.color ? 3 : 0));
    mesh.points.emplace_back(given[0], given[1], given[2]);
    if (!layout.color) continue;
    mesh.colors.emplace_back(given[before], given[before + 1], given[before + 2]);
  }
  // Colors are numbers up to 255, or up to 1. Some programs write 1.0 as 1, so whether they are integers does not tell.
  const auto is_above_one = [](const Vector& color) { return color.maxCoeff() > 1.0; };
  if (std::ranges::any_of(mesh.colors, is_above_one)) {
    for (Vector& color : mesh.colors) color /= 255.0;
  }
  for (std::int64_t f = 0; f < faces; ++f) {
    lines.need("face " + std::to_string(f) + " of " + std::to_string(faces));
    const std::int64_t size = lines.integer(0);
    if (size < 3) lines.fail("a face needs 3 corners");
    for (std::int64_t i = 1; i <= size; ++i) {
      const std::int64_t v = lines.integer(static_cast<std::size_t>(i));
      if (v < 0 || v >= vertices) {
        lines.fail("there is no vertex " + std::to_string(v) + " among " + std::to_string(vertices));
      }
      mesh.corners.push_back(static_cast<std::int32_t>(v));
    }
    mesh.sizes.push_back(static_cast<std::int32_t>(size));
  }
  return mesh;
}

std::string write_off(const PolygonMesh& mesh) {
  std::string text = mesh.colors.empty() ? "OFF\n" : "COFF\n";
  text += std::to_string(mesh.points.size()) + ' ' + std::to_string(mesh.sizes.size()) + " 0\n";
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vector& p = mesh.points[v];
    append_number(text, p.x());
    append_number(text += ' ', p.y());
    append_number(text += ' ', p.z());
    if (!mesh.colors.empty()) {
      for (const double x : mesh.colors[v]) {
        append_number(text += ' ', x);
        if (x == 0.0 || x == 1.0) text += ".0";  // some programs read 1 as 1 / 255
      }
      text += " 1.0";
    }
    text += '\n';
  }
  const std::int32_t* corner = mesh.corners.data();
  for (const std::int32_t size : mesh.sizes) {
    text += std::to_string(size);
    for (std::int32_t i = 0; i < size; ++i) (text += ' ') += std::to_string(*corner++);
    text += '\n';
  }
  return text;
}

}  // namespace seamwire::detail
