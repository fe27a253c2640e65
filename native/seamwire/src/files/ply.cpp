// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "detail/index.hpp"
#include "files/bytes.hpp"
#include "files/formats.hpp"
#include "files/text_lines.hpp"
#include "seamwire/files/mesh_file.hpp"

namespace seamwire::detail {
namespace {

/// A type of numbers, by both of its names.
struct Type {
  std::string_view name, sized_name;
  std::size_t bytes;
  double (*read)(const char*, std::endian);
  double largest;  ///< what a color of 1 is
};

template <class T>
double read_as(const char* bytes, std::endian order) {
  return static_cast<double>(number_at<T>(bytes, order));
}

template <class T>
constexpr Type type_of(std::string_view name, std::string_view sized_name) {
  return {name, sized_name, sizeof(T), &read_as<T>,
          std::numeric_limits<T>::is_integer ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0};
}

constexpr std::array kTypes = {
    type_of<std::int8_t>("char", "int8"),    type_of<std::uint8_t>("uchar", "uint8"),
    type_of<std::int16_t>("short", "int16"), type_of<std::uint16_t>("ushort", "uint16"),
    type_of<std::int32_t>("int", "int32"),   type_of<std::uint32_t>("uint", "uint32"),
    type_of<float>("float", "float32"),      type_of<double>("double", "float64"),
};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count = nullptr;  ///< of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> find(std::string_view name_of_property) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == name_of_property) return i;
    }
    return std::nullopt;
  }
};

struct Header {
  std::optional<std::endian> binary;  ///< the byte order, or none for text
  std::vector<Element> elements;
};

const Type* type_from(const TextLines& lines, std::size_t word) {
  if (word >= lines.words().size()) lines.fail("a type is missing");
  for (const Type& type : kTypes) {
    if (lines.words()[word] == type.name || lines.words()[word] == type.sized_name) return &type;
  }
  lines.fail("'" + std::string(lines.words()[word]) + "' is not a type of PLY");
}

/// Reads a line of the header that describes a property.
Property property_from(const TextLines& lines) {
  const std::vector<std::string_view>& words = lines.words();
  const bool is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (is_list ? 5U : 3U)) lines.fail("a property needs types and a name");
  Property property{.name = std::string(words.back()), .type = type_from(lines, words.size() - 2), .count = nullptr};
  if (is_list) {
    property.count = type_from(lines, 2);
    if (property.count->largest == 1.0) lines.fail("the length of a list is no integer");
  }
  return property;
}

/// Reads the header, and leaves `lines` behind it.
Header read_header(TextLines& lines) {
  lines.need("its first word");
  if (lines.words().front() != "ply") lines.fail("the file does not begin with ply");
  lines.need("its format");
  Header header;
  const std::vector<std::string_view>& words = lines.words();
  if (words.size() < 2 || words[0] != "format") lines.fail("the format is missing");
  if (words[1] == "binary_little_endian") {
    header.binary = std::endian::little;
  } else if (words[1] == "binary_big_endian") {
    header.binary = std::endian::big;
  } else if (words[1] != "ascii") {
    lines.fail("'" + std::string(words[1]) + "' is not a format of PLY");
  }
  for (lines.need("end_header"); words.front() != "end_header"; lines.need("end_header")) {
    if (words[0] == "element") {
      if (words.size() != 3) lines.fail("an element needs a name and a number");
      header.elements.push_back({.name = std::string(words[1]), .count = lines.integer(2), .properties = {}});
      if (header.elements.back().count < 0) lines.fail("the number of elements is negative");
    } else if (words[0] == "property") {
      if (header.elements.empty()) lines.fail("a property comes before the first element");
      header.elements.back().properties.push_back(property_from(lines));
    } else if (words[0] != "comment" && words[0] != "obj_info") {
      lines.fail("'" + std::string(words[0]) + "' does not belong into a header");
    }
  }
  return header;
}

/// The values of one element after another, from text or from bytes.
class Values {
 public:
  Values(std::string name, TextLines& lines, std::optional<std::endian> binary)
      : name_(std::move(name)), lines_(lines), bytes_(lines.rest()), binary_(binary) {}

  /// Reads element `number`. Then at(p) has the values of its property p.
  void read(const Element& element, std::int64_t number) {
    element_ = &element;
    number_ = number;
    word_ = 0;
    if (!binary_) lines_.need(element.name + " " + std::to_string(number) + " of " + std::to_string(element.count));
    values_.resize(element.properties.size());
    for (std::size_t p = 0; p < values_.size(); ++p) {
      const Property& property = element.properties[p];
      values_[p].clear();
      std::size_t count = 1;
      if (property.count != nullptr) {
        const double given = next(*property.count);
        if (!(given >= 0 && given == std::floor(given)))
          fail("the length of list " + property.name + " is not 0, 1, 2, ...");
        const std::size_t most = binary_ ? bytes_.size() / property.type->bytes : lines_.words().size();
        if (given > static_cast<double>(most)) {
          fail("list " + property.name + " is longer than the " + (binary_ ? "file" : "line"));
        }
        count = static_cast<std::size_t>(given);
      }
      for (std::size_t i = 0; i < count; ++i) values_[p].push_back(next(*property.type));
    }
  }

  const std::vector<double>& at(std::size_t property) const { return values_[property]; }

  /// Throws FileError, which names the line, or the element of a binary file.
  [[noreturn]] void fail(const std::string& what) const {
    if (!binary_) lines_.fail(what);
    throw FileError(name_ + ", " + element_->name + " " + std::to_string(number_) + ": " + what);
  }

 private:
  double next(const Type& type) {
    if (binary_) {
      if (bytes_.size() < type.bytes) fail("the file ends here");
      const double value = type.read(bytes_.data(), *binary_);
      bytes_.remove_prefix(type.bytes);
      return value;
    }
    if (word_ >= lines_.words().size()) fail("a number is missing at the end");
    const std::string_view word = lines_.words()[word_++];
    const std::optional<double> value = number_from(word);
    if (!value) fail("'" + std::string(word) + "' is not a number");
    return *value;
  }

  std::string name_;
  TextLines& lines_;
  std::string_view bytes_;
  std::optional<std::endian> binary_;
  const Element* element_ = nullptr;
  std::int64_t number_ = 0;
  std::size_t word_ = 0;
  std::vector<std::vector<double>> values_;
};

using Three = std::array<std::size_t, 3>;

/// Which properties of an element have these names.
std::optional<Three> find_three(const Element& element, std::array<std::string_view, 3> names) {
  Three found{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<std::size_t> p = element.find(names[i]);
    if (!p || element.properties[*p].count != nullptr) return std::nullopt;
    found[i] = *p;
  }
  return found;
}

void read_vertices(const std::string& name, const Element& element, Values& values, PolygonMesh& mesh) {
  const std::optional<Three> at = find_three(element, {"x", "y", "z"});
  if (!at) throw FileError(name + ": vertices have no x, y and z");
  const std::optional<Three> color = find_three(element, {"red", "green", "blue"});
  for (std::int64_t v = 0; v < element.count; ++v) {
    values.read(element, v);
    Vector p, rgb;
    for (int i = 0; i < 3; ++i) {
      p[i] = values.at((*at)[index(i)]).front();
      if (!std::isfinite(p[i])) values.fail("a coordinate is not finite");
      if (color) rgb[i] = values.at((*color)[index(i)]).front() / element.properties[(*color)[index(i)]].type->largest;
    }
    mesh.points.push_back(p);
    if (color) mesh.colors.push_back(rgb);
  }
}

void read_faces(const Element& element, Values& values, PolygonMesh& mesh) {
  std::optional<std::size_t> list = element.find("vertex_indices");
  if (!list) list = element.find("vertex_index");
  for (std::int64_t f = 0; f < element.count; ++f) {
    values.read(element, f);
    if (!list || element.properties[*list].count == nullptr) values.fail("faces have no list vertex_indices");
    const std::vector<double>& corners = values.at(*list);
    if (corners.size() < 3) values.fail("a face needs 3 corners");
    for (const double v : corners) {
      if (!(v >= 0 && v < static_cast<double>(mesh.points.size()) && v == std::floor(v))) {
        std::string number;
        append_number(number, v);
        values.fail("there is no vertex " + number + " among " + std::to_string(mesh.points.size()));
      }
      mesh.corners.push_back(static_cast<std::int32_t>(v));
    }
    mesh.sizes.push_back(static_cast<std::int32_t>(corners.size()));
  }
}

}  // namespace

PolygonMesh read_ply(const std::string& name, std::string_view file) {
  TextLines lines(name, file, TextSyntax::kWords);
  const Header header = read_header(lines);
  Values values(name, lines, header.binary);
  PolygonMesh mesh;
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      has_vertices = true;
      read_vertices(name, element, values, mesh);
    } else if (element.name == "face") {
      if (!has_vertices) throw FileError(name + ": faces come before vertices");
      read_faces(element, values, mesh);
    } else if (element.name == "tristrips" && element.count > 0) {
      throw FileError(name + ": triangle strips cannot be read");
    } else if (!header.binary || !element.properties.empty()) {
      for (std::int64_t i = 0; i < element.count; ++i) values.read(element, i);
    }
  }
  if (!has_vertices) throw FileError(name + ": there are no vertices");
  return mesh;
}

std::string write_ply(const PolygonMesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!mesh.colors.empty()) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes +=
      "element face " + std::to_string(mesh.sizes.size()) + "\nproperty list uint int vertex_indices\nend_header\n";
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (const double x : mesh.points[v]) append_bytes(bytes, x);
    if (mesh.colors.empty()) continue;
    for (const double x : mesh.colors[v]) {
      bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(x, 0.0, 1.0)))));
    }
  }
  const std::int32_t* corner = mesh.corners.data();
  for (const std::int32_t size : mesh.sizes) {
    append_bytes(bytes, static_cast<std::uint32_t>(size));
    for (std::int32_t i = 0; i < size; ++i) append_bytes(bytes, *corner++);
  }
  return bytes;
}

}  // namespace seamwire::detail
