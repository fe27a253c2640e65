// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/files/mesh_file.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <random>
#include <string>
#include <vector>

#include "seamwire/errors.hpp"

namespace seamwire {
namespace {

using Numbers = std::vector<std::int32_t>;

class MeshFile : public testing::Test {
 protected:
  MeshFile() { std::filesystem::create_directories(folder_); }
  ~MeshFile() override { std::filesystem::remove_all(folder_); }
  MeshFile(const MeshFile&) = delete;
  MeshFile& operator=(const MeshFile&) = delete;

  std::filesystem::path at(const std::string& name) const { return folder_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(at(name), std::ios::binary) << bytes;
    return at(name);
  }

  std::string content(const std::string& name) const {
    std::ifstream file(at(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// What read_mesh() says of a file, without the folder.
  std::string said(const std::string& name, const std::string& bytes) const {
    try {
      read_mesh(write(name, bytes));
    } catch (const FileError& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.rfind(at(name).string(), 0), 0) << text;
      return text.substr(at("").string().size());
    }
    return "";
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      ("seamwire-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
       std::to_string(std::random_device()()));
};

/// Quads, a triangle and a pentagon, three faces at an edge, and numbers that single precision has not.
PolygonMesh example(bool colored) {
  PolygonMesh mesh{
      .points =
          {{0, 0, 0}, {1.0 / 3, 0, 0}, {1, 1e-17, 0}, {0, 1, 1e300}, {0.1, 0.2, 0.3}, {-5, 2.5, 1e-300}, {2, 2, 2}},
      .corners = {0, 1, 2, 3, 1, 0, 4, 0, 1, 5, 0, 1, 2, 6, 5},
      .sizes = {4, 3, 3, 5},
      .colors = {}};
  if (colored) {
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      mesh.colors.emplace_back(static_cast<double>(v) / 255.0, 1.0 - static_cast<double>(v) / 51.0,
                               v % 2 == 0 ? 1.0 : 0.0);
    }
  }
  return mesh;
}

void expect_same(const PolygonMesh& a, const PolygonMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.sizes, b.sizes);
  ASSERT_EQ(a.colors.size(), b.colors.size());
  for (std::size_t v = 0; v < a.colors.size(); ++v) EXPECT_LT((a.colors[v] - b.colors[v]).norm(), 1e-12) << v;
}

TEST_F(MeshFile, ReadsBackWhatItWrites) {
  for (const bool colored : {false, true}) {
    for (const char* name : {"mesh.obj", "mesh.ply", "mesh.off", "MESH.PLY"}) {
      SCOPED_TRACE(name);
      write_mesh(at(name), example(colored));
      expect_same(read_mesh(at(name)), example(colored));
      EXPECT_FALSE(std::filesystem::exists(at(std::string(name) + ".part0")));
    }
  }
}

TEST_F(MeshFile, StlFilesHaveTrianglesWhoseCornersAreJoined) {
  const PolygonMesh cube{.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                         .corners = {0, 1, 2, 3, 0, 1, 4},
                         .sizes = {4, 3},
                         .colors = {}};
  write_mesh(at("a.stl"), cube);
  const PolygonMesh read = read_mesh(at("a.stl"));
  EXPECT_EQ(read.points, cube.points);
  EXPECT_EQ(read.corners, (Numbers{0, 1, 2, 0, 2, 3, 0, 1, 4}));
  EXPECT_EQ(std::filesystem::file_size(at("a.stl")), 84 + 3 * 50);
}

TEST_F(MeshFile, ReadsWhatOthersWrite) {
  const PolygonMesh obj =
      read_mesh(write("a.obj",
                      "# Blender\r\nmtllib no.mtl\r\no Cube\r\nv 0 0 0 1 0 0\r\nv +1.5 0 -.5e1 0 1 0\r\n"
                      "v 1 1 0 0 0 1\r\nvt 0 0\r\nvn 0 0 1\r\nusemtl a\r\ns off\r\nl 1 2\r\n"
                      "f 1/1/1 2//1 \\\r\n3/1 # last\r\nv 3 3 3 0.5 0.5 0.5\r\nf -1 -2 -3 1\r\n"));
  EXPECT_EQ(obj.points[1], Vector(1.5, 0, -5));
  EXPECT_EQ(obj.corners, (Numbers{0, 1, 2, 3, 2, 1, 0}));
  EXPECT_EQ(obj.sizes, (Numbers{3, 4}));
  EXPECT_EQ(obj.colors[1], Vector(0, 1, 0));
  EXPECT_TRUE(read_mesh(write("b.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3")).colors.empty())
      << "not at each vertex";

  const PolygonMesh off = read_mesh(
      write("a.off", "COFF 3 1 0\n# a comment\n0 0 0 255 0 51 255\n1 0 0 0 0 255\n1 1 0 0 0 255 7\n3 0 1 2 9 9 9\n"));
  EXPECT_EQ(off.colors[0], Vector(1, 0, 0.2));
  EXPECT_EQ(off.colors[1], Vector(0, 0, 1));
  EXPECT_EQ(off.corners, (Numbers{0, 1, 2}));
  EXPECT_EQ(
      read_mesh(write("b.off", "STNOFF\n3 1 0\n0 0 0 0 0 1 .1 .2\n1 0 0 0 0 1 .1 .2\n1 1 0 0 0 1 .1 .2\n3 2 1 0\n"))
          .corners,
      (Numbers{2, 1, 0}));

  // Texture coordinates before and after the corners, lists whose length is an int, unknown elements.
  const PolygonMesh ply = read_mesh(
      write("a.ply",
            "ply\nformat ascii 1.0\ncomment # made by hand \\\nelement camera 1\nproperty float f\nelement vertex "
            "3\nproperty float32 z\n"
            "property double y\nproperty list int float weights\nproperty float x\nproperty ushort red\nproperty "
            "ushort green\nproperty ushort blue\n"
            "element face 1\nproperty float quality\nproperty list int uint vertex_index\nproperty list uchar float "
            "texcoord\nelement edge 1\nproperty int a\n"
            "end_header\n7\n0 1 2 .5 .5 2 65535 0 0\n0 1 0 3 0 0 0\n0 2 1 9 4 0 0 0\n0.5 3 2 1 0 6 0 0 0 0 0 0\n1\n"));
  EXPECT_EQ(ply.points, (std::vector<Vector>{{2, 1, 0}, {3, 1, 0}, {4, 2, 0}}));
  EXPECT_EQ(ply.corners, (Numbers{2, 1, 0}));
  EXPECT_EQ(ply.colors[0], Vector(1, 0, 0));

  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty short y\nproperty uchar "
      "z\nend_header\n";
  big += std::string("\x3f\x80\x00\x00\x01\x02\x07", 7);
  EXPECT_EQ(read_mesh(write("b.ply", big)).points, (std::vector<Vector>{{1, 258, 7}}));

  const std::string facet =
      "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex -0 1e0 0\n endloop\nendfacet\n";
  const std::string second =
      "facet normal 0 0 1\nouter loop\nvertex 0 1 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";
  const PolygonMesh stl = read_mesh(write("a.stl", "solid a # b\n" + facet + second + "endsolid a\n"));
  EXPECT_EQ(stl.points.size(), 4);
  EXPECT_EQ(stl.corners, (Numbers{0, 1, 2, 2, 1, 3}));
}

TEST_F(MeshFile, ReadsFilesOfOtherSystemsAndHabits) {
  // A byte order mark, ends of lines of old Macs, a path that ends with a backslash, colors with alpha.
  const PolygonMesh obj = read_mesh(
      write("a.obj",
            "\xef\xbb\xbfv 0 0 0 1 0 0 0.5\r# a\rmtllib C:\\models\\\rv 1 0 0 0 1 0 1\r\nv 1 1 0 0 0 1 1\nf 1 2 3\r"));
  EXPECT_EQ(obj.corners, (Numbers{0, 1, 2}));
  EXPECT_EQ(obj.colors[0], Vector(1, 0, 0));
  EXPECT_EQ(read_mesh(write("a.off", "OFF3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n")).corners, (Numbers{0, 1, 2}));
  const PolygonMesh off = read_mesh(write("b.off", "COFF\n2 0 0\n0 0 0 1 0 0 1\n1 0 0 .5 .5 .5 1\n"));
  EXPECT_EQ(off.colors[0], Vector(1, 0, 0)) << "1 is a number like .5";
  EXPECT_EQ(read_mesh(write("a.stl",
                            "  SOLID\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 1 1 "
                            "0\nENDLOOP\nENDFACET\nENDSOLID\n"))
                .sizes,
            (Numbers{3}));
}

TEST_F(MeshFile, ErrorsNameTheLine) {
  EXPECT_EQ(said("a.obj", "v 0 0 0\n\nv 1 0\n"), "a.obj, line 3: there are 2 numbers instead of 3");
  EXPECT_EQ(said("a.obj", "v 0 0 0\nv 1,5 0 0\n"), "a.obj, line 2: '1,5' is not a number");
  EXPECT_EQ(said("a.obj", "v 0 0 nan\n"), "a.obj, line 1: 'nan' is not finite");
  EXPECT_EQ(said("a.obj", "v 0 0 1e999\n"), "a.obj, line 1: '1e999' is not finite");
  EXPECT_EQ(said("a.obj", "v 0 0 1e-999\nf 1 1 2\n"),
            "a.obj, line 2: there is no vertex 2 among the 1 above this line");
  EXPECT_EQ(said("a.obj", "v 0 0 0\nf 1 0 1\n"), "a.obj, line 2: there is no vertex 0 among the 1 above this line");
  EXPECT_EQ(said("a.obj", "v 0 0 0\nf 1 x/1 1\n"), "a.obj, line 2: 'x/1' is not a corner of a face");
  EXPECT_EQ(said("a.obj", "v 0 0 0\nf 1 \\\n1\n"), "a.obj, line 2: a face needs 3 corners");
  EXPECT_EQ(said("a.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1 2\n"), "a.off, line 5: there is no vertex 2 among 2");
  EXPECT_EQ(said("a.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1\n"), "a.off, line 5: a number is missing at the end");
  EXPECT_EQ(said("a.off", "OFF\n2 1 0\n0 0 0\n"), "a.off: the file ends before vertex 1 of 2");
  EXPECT_EQ(said("a.off", "OFF\n2 4000000000 0\n0 0 0\n0 0 0\n"), "a.off: the file ends before face 0 of 4000000000");
  EXPECT_EQ(said("a.off", "OFF BINARY\n2 1 0\n"), "a.off, line 1: binary OFF files cannot be read");
  EXPECT_EQ(said("a.off", "4OFF\n2 1 0\n"), "a.off, line 1: '4OFF' is not OFF, COFF, NOFF or the like");
  EXPECT_EQ(said("a.off", ""), "a.off: the file ends before its first word");
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(said("a.ply", head + "end_header\n0 0\n"), "a.ply, line 8: a number is missing at the end");
  EXPECT_EQ(
      said("a.ply", head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 1\n"),
      "a.ply, line 11: there is no vertex 1 among 1");
  EXPECT_EQ(
      said("a.ply",
           head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n999999999999 0 0 1\n"),
      "a.ply, line 11: list vertex_indices is longer than the line");
  const std::string face = head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
  EXPECT_EQ(said("a.ply", face + "inf 0 0 0\n"), "a.ply, line 11: list vertex_indices is longer than the line");
  EXPECT_EQ(said("a.ply", face + "3.7 0 0 0 0\n"),
            "a.ply, line 11: the length of list vertex_indices is not 0, 1, 2, ...");
  EXPECT_EQ(said("a.ply", face + "3 0 0 1e300\n"), "a.ply, line 11: there is no vertex 1e+300 among 1");
  EXPECT_EQ(said("a.ply", "ply\nformat ascii 1.0\nproperty float x\n"),
            "a.ply, line 3: a property comes before the first element");
  EXPECT_EQ(said("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
            "a.ply, line 4: 'half' is not a type of PLY");
  EXPECT_EQ(said("a.ply", "ply\nformat ascii 1.0\nend_header\n"), "a.ply: there are no vertices");
  EXPECT_EQ(said("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n"),
            "a.stl, line 5: a facet has 1 corners instead of 3");
  EXPECT_EQ(said("a.stl", "solid\n"), "a.stl: the file ends before endsolid");
}

TEST_F(MeshFile, ErrorsNameTheElementOfBinaryFiles) {
  write_mesh(at("a.ply"), example(true));
  std::string bytes = content("a.ply");
  EXPECT_EQ(said("a.ply", bytes.substr(0, bytes.size() - 1)),
            "a.ply, face 3: list vertex_indices is longer than the file");
  EXPECT_EQ(said("a.ply", bytes.substr(0, bytes.size() - 21)), "a.ply, face 3: the file ends here");
  bytes[bytes.size() - 1] = 1;
  EXPECT_EQ(said("a.ply", bytes), "a.ply, face 3: there is no vertex 16777221 among 7");
  write_mesh(at("a.stl"),
             {.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, .corners = {0, 1, 2}, .sizes = {3}, .colors = {}});
  bytes = content("a.stl");
  EXPECT_EQ(read_mesh(write("a.stl", bytes + "xyz")).sizes, Numbers{3}) << "bytes at the end are ignored";
  EXPECT_EQ(said("a.stl", bytes.substr(0, bytes.size() - 1)), "a.stl: the file ends within triangle 0 of 1");
  EXPECT_EQ(said("a.stl", bytes.substr(0, 50)), "a.stl: the file ends within its first 84 bytes");
  bytes[84 + 12 + 3] = '\x7f', bytes[84 + 12 + 2] = '\x80';
  EXPECT_EQ(said("a.stl", bytes), "a.stl, triangle 0: a coordinate is not finite");
}

TEST_F(MeshFile, EveryPartOfAFileIsReadOrRefused) {
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    PolygonMesh mesh = example(true);
    for (Vector& p : mesh.points) p = p.cwiseMin(9.0);  // STL files have single precision
    write_mesh(at(name), mesh);
    const std::string bytes = content(name);
    EXPECT_NO_THROW(read_mesh(at(name)));
    std::mt19937 random(7);
    for (int i = 0; i < 100; ++i) {
      std::string broken = bytes.substr(0, i % 2 == 0 ? random() % bytes.size() : bytes.size());
      for (std::size_t k = random() % 4; k > 0 && !broken.empty(); --k)
        broken[random() % broken.size()] = static_cast<char>(random());
      try {
        const PolygonMesh read = read_mesh(write(name, broken));
        if (!read.corners.empty()) make_surface(read);
      } catch (const FileError&) {
      } catch (const InvalidInput&) {
      }
    }
  }
}

TEST_F(MeshFile, SaysWhichFilesItCannotReadOrWrite) {
  const auto error_of = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of([&] { read_mesh("a.fbx"); }), "a.fbx: the name must end in one of .obj, .ply, .stl, .off");
  EXPECT_EQ(error_of([&] { read_mesh("no/a.obj"); }), "no/a.obj: the file cannot be opened");
  EXPECT_EQ(error_of([&] { write_mesh("no/a.obj", example(false)); }), "no/a.obj: the file cannot be written");
  EXPECT_EQ(error_of([&] { write_lines("a.ply", {}); }), "a.ply: the name must end in .obj");
  PolygonMesh bad = example(false);
  bad.colors.resize(2, Vector::Zero());
  write("a.obj", "v 0 0 0\n");
  EXPECT_THROW(write_mesh(at("a.obj"), bad), InvalidInput);
  bad = example(false);
  bad.points[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_mesh(at("a.obj"), bad), InvalidInput);
  EXPECT_THROW(write_mesh(at("a.stl"), example(false)), InvalidInput) << "1e300";
  bad = example(false);
  bad.corners[3] = 99;
  EXPECT_THROW(write_mesh(at("a.obj"), bad), InvalidInput);
  EXPECT_EQ(content("a.obj"), "v 0 0 0\n") << "an error leaves the file as it was";
}

TEST_F(MeshFile, WritesLinesThatOthersRead) {
  const std::vector<std::vector<Vector>> lines = {
      {{0, 0, 0}, {0.1, 0, 0}}, {{1, 1, 1}}, {{2, 0, 0}, {3, 0, 0}, {4, 0, 0}}};
  write_lines(at("a.obj"), lines);
  EXPECT_EQ(content("a.obj"), "v 0 0 0\nv 0.1 0 0\nl 1 2\nv 1 1 1\nv 2 0 0\nv 3 0 0\nv 4 0 0\nl 4 5 6\n");
  write_lines(at("a.obj"), {lines[0]});
  EXPECT_EQ(content("a.obj"), "v 0 0 0\nv 0.1 0 0\nl 1 2\n");
}

/// Decimal commas, and dots between thousands.
class Commas : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_F(MeshFile, ALocaleWithDecimalCommasChangesNothing) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE", "German"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  PolygonMesh mesh = example(true);
  mesh.points.resize(1500, Vector(1234.5, 0.25, -7654321.125));
  mesh.colors.clear();
  mesh.corners.push_back(1499), mesh.corners.push_back(0), mesh.corners.push_back(1);
  mesh.sizes.push_back(3);
  for (const char* name : {"a.obj", "a.ply", "a.off"}) {
    write_mesh(at(name), mesh);
    expect_same(read_mesh(at(name)), mesh);
  }
  std::locale::global(before);
  std::setlocale(LC_ALL, c_before.c_str());
}

TEST(PolygonMesh, HasTheEdgesOfItsPolygons) {
  EXPECT_EQ(polygon_edges({.points = std::vector<Vector>(5, Vector::Zero()),
                           .corners = {0, 1, 2, 3, 2, 1, 4, 4},
                           .sizes = {4, 4},
                           .colors = {}}),
            (std::vector<Edge>{{0, 1}, {0, 3}, {1, 2}, {1, 4}, {2, 3}, {2, 4}}));
  EXPECT_THROW(polygon_edges({.points = {}, .corners = {0, 1, 2}, .sizes = {3}, .colors = {}}), InvalidInput);
}

TEST(PolygonMesh, IsASurfaceWithoutTheDiagonals) {
  const Surface surface = make_surface(
      {.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .corners = {0, 1, 2, 3}, .sizes = {4}, .colors = {}});
  EXPECT_EQ(surface.face_count(), 2);
  EXPECT_EQ(surface.edges(), (std::vector<Edge>{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
}

}  // namespace
}  // namespace seamwire
