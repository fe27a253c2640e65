// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface_mesh_shortest_path of CGAL (GPL; the exact algorithm of Xin and Wang, 2009), for peers.py:
//   cgal_bench MESH.off SEED...
// Prints seconds of processor time. The first line is for building the mesh from points and triangles, and the solver.
// Then comes a line for each seed: the sequence tree, and asking for the distance of every vertex.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

}  // namespace

int main(int argc, char** argv) {
  Mesh read;
  if (argc < 3 || !(std::ifstream(argv[1]) >> read)) {
    std::fprintf(stderr, "usage: cgal_bench MESH.off SEED...\n");
    return 1;
  }
  const auto since = [](std::clock_t start) { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  std::clock_t start = std::clock();
  Mesh mesh;  // once more, without reading: all that are compared begin at points and triangles
  for (const auto v : read.vertices()) mesh.add_vertex(read.point(v));
  for (const auto f : read.faces()) {
    const auto range = CGAL::vertices_around_face(read.halfedge(f), read);
    mesh.add_face(std::vector<Mesh::Vertex_index>(range.begin(), range.end()));
  }
  Paths paths(mesh);
  std::printf("%.6f\n", since(start));
  for (int i = 2; i < argc; ++i) {
    start = std::clock();
    paths.remove_all_source_points();
    paths.add_source_point(Mesh::Vertex_index(static_cast<Mesh::size_type>(std::stoul(argv[i]))));
    double sum = 0.0;
    for (const auto v : mesh.vertices()) sum += paths.shortest_distance_to_source_points(v).first;
    std::printf("%.6f %.12g\n", since(start), sum);
    std::fflush(stdout);
  }
}
