// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's segmentation by shape diameters (GPL; Shapira, Shamir and Cohen-Or, 2008), for limbs.py:
//   cgal_segments MESH.off CLUSTERS...
// Prints a line for each number of clusters: seconds of processor time for the shape diameters, which are computed
// once, and for the clusters, then the segment of each face.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>

#include <cstddef>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc < 3 || !(std::ifstream(argv[1]) >> mesh)) {
    std::fprintf(stderr, "usage: cgal_segments MESH.off CLUSTERS...\n");
    return 1;
  }
  const auto since = [](std::clock_t start) { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  const std::clock_t start = std::clock();
  const auto diameters = mesh.add_property_map<Mesh::Face_index, double>("f:diameter").first;
  const auto segments = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  CGAL::sdf_values(mesh, diameters);
  const double measured = since(start);
  for (int i = 2; i < argc; ++i) {
    const std::clock_t clustering = std::clock();
    CGAL::segmentation_from_sdf_values(mesh, diameters, segments, std::stoul(argv[i]));
    std::printf("%.6f %.6f", measured, since(clustering));
    for (const auto face : mesh.faces()) std::printf(" %zu", segments[face]);
    std::printf("\n");
  }
}
