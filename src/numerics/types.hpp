// Eigen aliases used everywhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dygita {

using Vec = Eigen::VectorXd;
using Mat = Eigen::MatrixXd;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Points = Eigen::Matrix3Xd;                           // one column per node
using Tensors = Eigen::Matrix<double, 6, Eigen::Dynamic>;  // one column per node: xx yy zz xy yz zx
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// How the entries of a factor or an interface operator are kept; arithmetic is in double precision either way.
enum class Precision { double_precision, single_precision };

}  // namespace dygita
