#pragma once

#include <Eigen/Core>

namespace rvbench {

/// A·B, compiled once: as an expression, it is half a second to compile in every file.
Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                        const Eigen::Ref<const Eigen::MatrixXd>& b);
Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                         const Eigen::Ref<const Eigen::MatrixXcd>& b);

/// Aᵀ·A
Eigen::MatrixXd gram(const Eigen::Ref<const Eigen::MatrixXd>& a);

}  // namespace rvbench
