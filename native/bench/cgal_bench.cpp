// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surface_mesh_shortest_path of CGAL (GPL; the exact algorithm of Xin and Wang, 2009), for peers.py:
//   cgal_bench MESH.off SEED...
// prints the seconds of processor time of each seed: building the sequence tree, and asking for the distance of every
// vertex.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

}  // namespace

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc < 3 || !(std::ifstream(argv[1]) >> mesh)) {
    std::fprintf(stderr, "usage: cgal_bench MESH.off SEED...\n");
    return 1;
  }
  for (int i = 2; i < argc; ++i) {
    const std::clock_t start = std::clock();
    Paths paths(mesh);
    paths.add_source_point(Mesh::Vertex_index(static_cast<Mesh::size_type>(std::stoul(argv[i]))));
    double sum = 0.0;
    for (const auto v : mesh.vertices()) sum += paths.shortest_distance_to_source_points(v).first;
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%.6f %.12g\n", seconds, sum);
    std::fflush(stdout);
  }
}
