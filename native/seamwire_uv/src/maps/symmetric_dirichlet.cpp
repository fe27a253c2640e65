// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/symmetric_dirichlet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "detail/index.hpp"
#include "detail/infinity.hpp"

namespace seamwire::detail {
namespace {

using Complex = std::complex<double>;

/// Lower triangles than this part of their longest side are treated as if they were that high: maps of flatter ones
/// would depend on rounding.
constexpr double kLeastShapeHeight = 1e-4;
/// Sides shorter than this part of the square root of the island's area are treated as if they were that long.
constexpr double kLeastShapeSize = 1e-7;

/// Corners 1 and 2 of a flat triangle with corner 0 at the origin.
struct FlatTriangle {
  Complex corner1, corner2;
  double area() const { return 0.5 * (std::conj(corner1) * corner2).imag(); }
};

/// The triangle laid flat. `least`: the least length of its longest side.
FlatTriangle laid_flat(const std::array<Vector, 3>& corners, double least) {
  std::array<double, 3> squares{};  // of the side from corner i to the next
  for (std::size_t i = 0; i < 3; ++i) squares[i] = (corners[(i + 1) % 3] - corners[i]).squaredNorm();
  const auto base = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
  double length = std::sqrt(squares[base]);
  std::array<Complex, 3> flat{};
  if (length < least) {
    // Too small to have a shape: an equilateral one.
    length = least;
    flat[(base + 2) % 3] = length * Complex(0.5, std::sqrt(0.75));
  } else {
    const Vector along = (corners[(base + 1) % 3] - corners[base]) / length;
    const Vector up = corners[(base + 2) % 3] - corners[base];
    const double foot = up.dot(along);
    flat[(base + 2) % 3] = Complex(foot, std::max(up.cross(along).norm(), kLeastShapeHeight * length));
  }
  flat[(base + 1) % 3] = length;
  return {flat[1] - flat[0], flat[2] - flat[0]};
}

}  // namespace

SymmetricDirichlet::SymmetricDirichlet(std::vector<Triangle> triangles, std::span<const Vector> points)
    : triangles_(std::move(triangles)) {
  const std::size_t count = triangles_.size();
  std::vector<FlatTriangle> flat(count);
  // A second time in a unit in which the area is about 1.
  for (int pass = 0; pass < 2; ++pass) {
    if (pass > 0) unit_ = std::ldexp(1.0, std::ilogb(std::sqrt(area_)));
    area_ = 0.0;
    for (std::size_t f = 0; f < count; ++f) {
      std::array<Vector, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = points[index(triangles_[f][i])] / unit_;
      flat[f] = laid_flat(corners, kLeastShapeSize);
      area_ += flat[f].area();
    }
  }
  for (std::vector<double>* array : {&own_.p1x, &own_.p1y, &own_.p2x, &own_.p2y, &weights_}) array->resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    // Hat functions: grad phi_1 is corner 2 turned clockwise over twice the area, grad phi_2 corner 1 turned the other
    // way; the complex derivative is half the conjugate of the gradient.
    const auto& [corner1, corner2] = flat[f];
    const double doubled = 2.0 * flat[f].area();
    const Complex p1 = 0.5 * std::conj(Complex(corner2.imag(), -corner2.real())) / doubled;
    const Complex p2 = 0.5 * std::conj(Complex(-corner1.imag(), corner1.real())) / doubled;
    own_.p1x[f] = p1.real();
    own_.p1y[f] = p1.imag();
    own_.p2x[f] = p2.real();
    own_.p2y[f] = p2.imag();
    weights_[f] = flat[f].area() / area_;
  }
  current_ = own_;
}

RestShapes SymmetricDirichlet::rest_of(const Shapes& shapes, std::size_t begin) const {
  return {shapes.p1x.data() + begin, shapes.p1y.data() + begin, shapes.p2x.data() + begin, shapes.p2y.data() + begin,
          weights_.data() + begin};
}

void SymmetricDirichlet::set_sides(std::span<const double> map, std::size_t begin, std::size_t count,
                                   Sides& sides) const {
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle& t = triangles_[begin + i];
    const double* corner0 = map.data() + 2 * index(t[0]);
    const double* corner1 = map.data() + 2 * index(t[1]);
    const double* corner2 = map.data() + 2 * index(t[2]);
    sides.e1x[i] = corner1[0] - corner0[0];
    sides.e1y[i] = corner1[1] - corner0[1];
    sides.e2x[i] = corner2[0] - corner0[0];
    sides.e2y[i] = corner2[1] - corner0[1];
  }
}

template <class Visit>
void SymmetricDirichlet::for_each_group(std::span<const double> map, const Visit& visit) const {
  Sides sides;
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kTrianglesAtOnce) {
    const std::size_t count = std::min(kTrianglesAtOnce, triangles_.size() - begin);
    set_sides(map, begin, count, sides);
    visit(begin, count, sides);
  }
}

double SymmetricDirichlet::energy(std::span<const double> map) const {
  const DirichletKernels& kernels = dirichlet_kernels().fastest();
  double sum = 0.0;
  std::array<double, kTrianglesAtOnce> energies;
  for_each_group(map, [&](std::size_t begin, std::size_t count, const Sides& sides) {
    kernels.energies(rest_of(current_, begin), sides, count, energies.data());
    for (std::size_t i = 0; i < count; ++i) sum += weights_[begin + i] * energies[i];
  });
  return sum;
}

std::vector<double> SymmetricDirichlet::energies(std::span<const double> map) const {
  const DirichletKernels& kernels = dirichlet_kernels().fastest();
  std::vector<double> energies(triangles_.size());
  for_each_group(map, [&](std::size_t begin, std::size_t count, const Sides& sides) {
    kernels.energies(rest_of(current_, begin), sides, count, energies.data() + begin);
  });
  return energies;
}

std::vector<std::array<double, 2>> SymmetricDirichlet::parts(std::span<const double> map) const {
  std::vector<std::array<double, 2>> parts(triangles_.size());
  for_each_group(map, [&](std::size_t begin, std::size_t count, const Sides& sides) {
    const RestShapes rest = rest_of(current_, begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Complex p1(rest.p1x[i], rest.p1y[i]), p2(rest.p2x[i], rest.p2y[i]);
      const Complex e1(sides.e1x[i], sides.e1y[i]), e2(sides.e2x[i], sides.e2y[i]);
      const double cross = (std::conj(e1) * e2).imag(), determinant = cross * -4.0 * (std::conj(p1) * p2).imag();
      const double squared = 2.0 * (std::norm(p1 * e1 + p2 * e2) + std::norm(std::conj(p1) * e1 + std::conj(p2) * e2));
      parts[begin + i] = {kInfinity, kInfinity};
      if (cross > 0.0) parts[begin + i] = {squared, squared / determinant / determinant};
    }
  });
  return parts;
}

void SymmetricDirichlet::add_derivatives(std::span<const double> map, std::span<const TriangleBlocks> blocks,
                                         std::span<double> gradient, std::span<double> values) const {
  const DirichletKernels& kernels = dirichlet_kernels().fastest();
  Derivatives d;
  for_each_group(map, [&](std::size_t begin, std::size_t count, const Sides& sides) {
    kernels.derivatives(rest_of(current_, begin), sides, count, d);
    for (std::size_t i = 0; i < count; ++i) {
      const Triangle& t = triangles_[begin + i];
      const TriangleBlocks& b = blocks[begin + i];
      const auto add_gradient = [&](std::int32_t v, double x, double y) {
        gradient[2 * index(v)] += x;
        gradient[2 * index(v) + 1] += y;
      };
      add_gradient(t[0], -(d.g1x[i] + d.g2x[i]), -(d.g1y[i] + d.g2y[i]));
      add_gradient(t[1], d.g1x[i], d.g1y[i]);
      add_gradient(t[2], d.g2x[i], d.g2y[i]);
      const auto add_diagonal = [&](const BlockEntry& at, double xx, double xy, double yy) {
        double* to = values.data() + at.offset;
        to[0] += xx;
        to[at.row] += xy;
        to[at.row + at.column] += yy;
      };
      const auto add_block = [&](const BlockEntry& at, double xx, double xy, double yx, double yy) {
        double* to = values.data() + at.offset;
        to[0] += xx;
        to[at.column] += xy;
        to[at.row] += yx;
        to[at.row + at.column] += yy;
      };
      // Rows and columns of all corners together add up to zero.
      const double r1xx = d.h11xx[i] + d.h12xx[i], r1xy = d.h11xy[i] + d.h12xy[i];
      const double r1yx = d.h11xy[i] + d.h12yx[i], r1yy = d.h11yy[i] + d.h12yy[i];
      const double r2xx = d.h12xx[i] + d.h22xx[i], r2xy = d.h12yx[i] + d.h22xy[i];
      const double r2yx = d.h12xy[i] + d.h22xy[i], r2yy = d.h12yy[i] + d.h22yy[i];
      add_diagonal(b[0], r1xx + r2xx, r1xy + r2xy, r1yy + r2yy);
      add_diagonal(b[1], d.h11xx[i], d.h11xy[i], d.h11yy[i]);
      add_diagonal(b[2], d.h22xx[i], d.h22xy[i], d.h22yy[i]);
      add_block(b[3], -r1xx, -r1yx, -r1xy, -r1yy);
      add_block(b[4], d.h12xx[i], d.h12xy[i], d.h12yx[i], d.h12yy[i]);
      add_block(b[5], -r2xx, -r2xy, -r2yx, -r2yy);
    }
  });
}

double SymmetricDirichlet::first_flip(std::span<const double> map, std::span<const double> direction) const {
  const DirichletKernels& kernels = dirichlet_kernels().fastest();
  double least = kInfinity;
  std::array<double, kTrianglesAtOnce> steps;
  Sides moves;
  for_each_group(map, [&](std::size_t begin, std::size_t count, const Sides& sides) {
    set_sides(direction, begin, count, moves);
    kernels.first_flips(sides, moves, count, steps.data());
    for (std::size_t i = 0; i < count; ++i) least = std::min(least, steps[i]);
  });
  return least;
}

std::size_t SymmetricDirichlet::move_rest_shapes(std::span<const double> map, double limit) {
  current_ = own_;
  const std::vector<double> energies = this->energies(map);
  // For singular values s, the energy of s^k is the sum of 2 cosh(2 k log s). Twice the larger term must not exceed the
  // limit.
  const double most = 0.5 * std::acosh(limit / 4.0);
  std::size_t moved = 0;
  for (std::size_t f = 0; f < energies.size(); ++f) {
    if (!(energies[f] > limit)) continue;
    ++moved;
    const auto corner = [&](std::size_t i) {
      const double* at = map.data() + 2 * index(triangles_[f][i]);
      return Complex(at[0], at[1]);
    };
    const Complex p1(own_.p1x[f], own_.p1y[f]), p2(own_.p2x[f], own_.p2y[f]);
    const Complex e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    const Complex p = p1 * e1 + p2 * e2, q = std::conj(p1) * e1 + std::conj(p2) * e2;
    const double determinant = (std::conj(e1) * e2).imag() * -4.0 * (std::conj(p1) * p2).imag();
    const double s1 = std::abs(p) + std::abs(q), s2 = determinant / s1;
    const double larger = std::max(std::abs(std::log(s1)), std::abs(std::log(s2)));
    const double share = std::max(0.0, 1.0 - most / larger);
    // The rest shape is stretched by s^share along the singular directions, so the hat functions' gradients shrink.
    const double shrink1 = std::pow(s1, -share), shrink2 = std::pow(s2, -share);
    const Complex turn = p * std::conj(q);
    const Complex direction = std::abs(turn) > 0.0 ? turn / std::abs(turn) : Complex(1.0);
    const auto moved_to = [&](const Complex& of) {
      return 0.5 * ((shrink1 + shrink2) * of + (shrink1 - shrink2) * direction * std::conj(of));
    };
    const Complex m1 = moved_to(p1), m2 = moved_to(p2);
    current_.p1x[f] = m1.real();
    current_.p1y[f] = m1.imag();
    current_.p2x[f] = m2.real();
    current_.p2y[f] = m2.imag();
  }
  return moved;
}

}  // namespace seamwire::detail
