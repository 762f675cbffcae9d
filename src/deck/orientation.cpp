#include "deck/orientation.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>

#include "base/error.hpp"

namespace dygita {

namespace {

using AxesAt = std::function<Mat3(const Vec3&)>;  // by the middle of a cell, m

constexpr const char* word = "orientation";
constexpr double least_sine = 1e-6;  // between two axes

std::string text_of(const Vec3& x) { return fmt::format("({:g}, {:g}, {:g})", x[0], x[1], x[2]); }

// Axis 1 along the first, axis 2 in the plane of both.
Mat3 axes_of(const Vec3& one, const Vec3& two, const std::string& where) {
  const Vec3 across = one.cross(two);
  if (!(across.norm() > least_sine * one.norm() * two.norm()))
    throw InputError(
        fmt::format("'{}'{}: the axes {} and {} are parallel, or one of them is zero\n    axis 1 is along "
                    "the first, axis 2 in the plane of both, axis 3 across",
                    word, where, text_of(one), text_of(two)));
  Mat3 axes;
  axes.col(0) = one.normalized();
  axes.col(2) = across.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// Axis 1 around the axis of the cylinder, 2 along it, 3 outwards; 1 and 2 turned about 3.
Mat3 axes_around(const Vec3& along, const Vec3& about, double angle, const Vec3& x) {
  const Vec3 arm = x - about, out = arm - along.dot(arm) * along;
  if (!(out.norm() > least_sine * arm.norm()))
    throw InputError(
        fmt::format("'{}': the middle of a cell, {} m, is on the axis of the cylinder, where nothing is "
                    "around it",
                    word, text_of(x)));
  const Vec3 outward = out.normalized(), around = along.cross(outward);
  Mat3 axes;
  axes << std::cos(angle) * around + std::sin(angle) * along, std::cos(angle) * along - std::sin(angle) * around,
      outward;
  return axes;
}

AxesAt rule_of(const LuaArguments& a) {
  if (!a.has(word)) return [](const Vec3&) -> Mat3 { return Mat3::Identity(); };
  if (a.is_function(word))
    return [&a](const Vec3& x) {
      const std::array<Vec3, 2> axes = a.two_vectors_at(word, x);
      return axes_of(axes[0], axes[1], " at " + text_of(x) + " m");
    };
  // Six numbers of two axes, or an axis, a point of it and an angle (lua/check.lua).
  const std::vector<double> given = a.numbers(word);
  const Vec3 one(given[0], given[1], given[2]), two(given[3], given[4], given[5]);
  if (given.size() == 6) return [axes = axes_of(one, two, "")](const Vec3&) { return axes; };
  if (one.isZero(0.0)) throw InputError(fmt::format("'{}.axis' is zero\n    as in axis = {{ 0, 0, 1 }}", word));
  return [along = Vec3(one.normalized()), two, angle = given[6]](const Vec3& x) {
    return axes_around(along, two, angle, x);
  };
}

}  // namespace

MeshPtr oriented(const Mesh& mesh, const LuaArguments& arguments) {
  const AxesAt axes_at = rule_of(arguments);
  std::vector<std::vector<Mat3>> axes;
  for (const CellBlock& block : mesh.blocks) {
    std::vector<Mat3>& of_block = axes.emplace_back();
    const int n = cell_shape(block.type).n_corners;
    for (int i = 0; i < block.n_cells(); ++i) {
      Vec3 middle = Vec3::Zero();
      for (int a = 0; a < n; ++a) middle += mesh.nodes.col(block.cell(i)[a]) / n;
      of_block.push_back(axes_at(middle));
    }
  }
  return oriented_mesh(mesh, std::move(axes));
}

}  // namespace dygita
