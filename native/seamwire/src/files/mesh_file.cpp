// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/files/mesh_file.hpp"

#include <array>
#include <cctype>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <system_error>

#include "files/formats.hpp"
#include "seamwire/errors.hpp"

namespace seamwire {
namespace {

struct Format {
  std::string_view ending;
  PolygonMesh (*read)(const std::string&, std::string_view);
  std::string (*write)(const PolygonMesh&);
};

constexpr std::array kFormats = {
    Format{".obj", &detail::read_obj, &detail::write_obj},
    Format{".ply", &detail::read_ply, &detail::write_ply},
    Format{".stl", &detail::read_stl, &detail::write_stl},
    Format{".off", &detail::read_off, &detail::write_off},
};

/// The name of a file for messages, in UTF-8.
std::string name_of(const std::filesystem::path& path) {
  const std::u8string name = path.u8string();
  return {name.begin(), name.end()};
}

const Format& format_of(const std::filesystem::path& path) {
  std::string ending = name_of(path.extension());
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Format& format : kFormats) {
    if (ending == format.ending) return format;
  }
  std::string endings;
  for (const Format& format : kFormats) endings += (endings.empty() ? "" : ", ") + std::string(format.ending);
  throw FileError(name_of(path) + ": the name must end in one of " + endings);
}

/// A name beside a file that no other file has.
std::filesystem::path unused_name(const std::filesystem::path& path) {
  for (int i = 0;; ++i) {
    std::filesystem::path name = path;
    name += ".part" + std::to_string(i);
    std::error_code error;
    if (!std::filesystem::exists(name, error)) return name;
  }
}

/// Writes a new file, which then replaces the one at `given`. An error does not change that one.
void replace(const std::filesystem::path& given, const std::string& bytes) {
  std::error_code unknown;
  std::filesystem::path path = std::filesystem::weakly_canonical(given, unknown);  // what a link points to
  if (unknown) path = given;
  const std::filesystem::path part = unused_name(path);
  std::ofstream file(part, std::ios::binary);
  if (!file) throw FileError(name_of(given) + ": the file cannot be written");
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(part, path, error);
  if (file && !error) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw FileError(name_of(given) + ": the file cannot be written" + (error ? ": " + error.message() : ""));
}

}  // namespace

PolygonMesh read_mesh(const std::filesystem::path& path) {
  const Format& format = format_of(path);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::error_code error;
  if (!file || std::filesystem::is_directory(path, error))
    throw FileError(name_of(path) + ": the file cannot be opened");
  const std::streamoff size = file.tellg();
  if (size < 0) throw FileError(name_of(path) + ": the file cannot be read");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw FileError(name_of(path) + ": the file cannot be read");
  }
  return format.read(name_of(path), bytes);
}

void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh) {
  const Format& format = format_of(path);
  check(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!mesh.points[v].allFinite()) throw InvalidInput("points: vertex " + std::to_string(v) + " is not finite");
  }
  replace(path, format.write(mesh));
}

void write_lines(const std::filesystem::path& path, const std::vector<std::vector<Vector>>& lines) {
  if (format_of(path).ending != ".obj") throw FileError(name_of(path) + ": the name must end in .obj");
  replace(path, detail::write_obj_lines(lines));
}

}  // namespace seamwire
