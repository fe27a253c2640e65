// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "detail/index.hpp"
#include "files/formats.hpp"
#include "files/text_lines.hpp"

namespace seamwire::detail {

PolygonMesh read_obj(const std::string& name, std::string_view file) {
  PolygonMesh mesh;
  TextLines lines(name, file, TextSyntax::kCommentsAndJoinedLines);
  while (lines.next()) {
    const std::string_view kind = lines.words().front();
    if (kind == "v") {
      // x y z, then optionally w, or a color with or without alpha.
      const std::vector<double>& given = lines.numbers(1, 3);
      mesh.points.emplace_back(given[0], given[1], given[2]);
      if (given.size() >= 6) mesh.colors.emplace_back(given[3], given[4], given[5]);
    } else if (kind == "f") {
      const auto count = static_cast<std::int64_t>(mesh.points.size());
      if (lines.words().size() < 4) lines.fail("a face needs 3 corners");
      for (std::size_t i = 1; i < lines.words().size(); ++i) {
        const std::string_view corner = lines.words()[i];
        const std::optional<std::int64_t> given = integer_from(corner.substr(0, corner.find('/')));
        if (!given) lines.fail("'" + std::string(corner) + "' is not a corner of a face");
        const std::int64_t v = *given < 0 ? count + *given : *given - 1;  // negative numbers count from the last vertex
        if (v < 0 || v >= count) {
          lines.fail("there is no vertex " + std::to_string(*given) + " among the " + std::to_string(count) +
                     " above this line");
        }
        mesh.corners.push_back(static_cast<std::int32_t>(v));
      }
      mesh.sizes.push_back(static_cast<std::int32_t>(lines.words().size() - 1));
    }
  }
  if (mesh.colors.size() != mesh.points.size()) mesh.colors.clear();
  return mesh;
}

namespace {

/// Appends numbers, each after a space.
void append_numbers(std::string& text, const Vector& numbers) {
  for (const double x : numbers) append_number(text += ' ', x);
}

}  // namespace

std::string write_obj(const PolygonMesh& mesh) {
  std::string text;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    append_numbers(text += 'v', mesh.points[v]);
    if (!mesh.colors.empty()) append_numbers(text, mesh.colors[v]);
    text += '\n';
  }
  const std::int32_t* corner = mesh.corners.data();
  for (const std::int32_t size : mesh.sizes) {
    text += 'f';
    for (std::int32_t i = 0; i < size; ++i) (text += ' ') += std::to_string(*corner++ + 1);
    text += '\n';
  }
  return text;
}

std::string write_obj_lines(std::span<const std::vector<Vector>> lines) {
  std::string text;
  std::size_t count = 0;
  for (const std::vector<Vector>& line : lines) {
    for (const Vector& p : line) {
      append_numbers(text += 'v', p);
      text += '\n';
    }
    if (line.size() > 1) {
      text += 'l';
      for (std::size_t i = 1; i <= line.size(); ++i) (text += ' ') += std::to_string(count + i);
      text += '\n';
    }
    count += line.size();
  }
  return text;
}

}  // namespace seamwire::detail
