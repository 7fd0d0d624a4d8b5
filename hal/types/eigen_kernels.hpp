#pragma once

#include <Eigen/Core>
#include <complex>

// Eigen's kernels of matrix products, compiled once. The precompiled header declares them here;
// eigen_kernels.cpp defines RVBENCH_KERNEL as `template` and instantiates them. A file without this
// header compiles its own copies, which the linker merges.
//
// Source  Eigen 3.4, src/Core/products/{GeneralMatrixMatrix,GeneralMatrixVector}.h
#ifndef RVBENCH_KERNEL
#define RVBENCH_KERNEL extern template
#endif

namespace Eigen::internal {

template <typename Scalar, int Order>
using RvbenchInput = const_blas_data_mapper<Scalar, Index, Order>;
template <typename Scalar>
using RvbenchOutput = blas_data_mapper<Scalar, Index, ColMajor>;

// Block times panel, and what copies blocks and panels.
#define RVBENCH_PANEL(Left, Right, conj_left, conj_right)                               \
  RVBENCH_KERNEL struct gebp_kernel<                                                    \
      Left, Right, Index, RvbenchOutput<ScalarBinaryOpTraits<Left, Right>::ReturnType>, \
      gebp_traits<Left, Right>::mr, gebp_traits<Left, Right>::nr, conj_left, conj_right>
#define RVBENCH_PACK(Scalar, order)                                                           \
  RVBENCH_KERNEL struct gemm_pack_lhs<Scalar, Index, RvbenchInput<Scalar, order>,             \
                                      gebp_traits<Scalar, Scalar>::mr,                        \
                                      gebp_traits<Scalar, Scalar>::LhsProgress,               \
                                      gebp_traits<Scalar, Scalar>::LhsPacket4Packing, order>; \
  RVBENCH_KERNEL struct gemm_pack_rhs<Scalar, Index, RvbenchInput<Scalar, order>,             \
                                      gebp_traits<Scalar, Scalar>::nr, order>
// Of a matrix in columns or rows, each as it is or conjugated.
#define RVBENCH_PRODUCT(Scalar, left, conj_left, right, conj_right)                           \
  RVBENCH_KERNEL struct general_matrix_matrix_product<Index, Scalar, left, conj_left, Scalar, \
                                                      right, conj_right, ColMajor, 1>
#define RVBENCH_VECTOR(Scalar, left, conj_left, right, conj_right, version) \
  RVBENCH_KERNEL struct general_matrix_vector_product<                      \
      Index, Scalar, RvbenchInput<Scalar, left>, left, conj_left, Scalar,   \
      RvbenchInput<Scalar, right>, conj_right, version>

RVBENCH_PANEL(double, double, false, false);
RVBENCH_PACK(double, ColMajor);
RVBENCH_PACK(double, RowMajor);
RVBENCH_PRODUCT(double, ColMajor, false, ColMajor, false);
RVBENCH_PRODUCT(double, ColMajor, false, RowMajor, false);
RVBENCH_PRODUCT(double, RowMajor, false, ColMajor, false);
RVBENCH_VECTOR(double, ColMajor, false, ColMajor, false, 0);
RVBENCH_VECTOR(double, ColMajor, false, RowMajor, false, 0);
RVBENCH_VECTOR(double, RowMajor, false, ColMajor, false, 0);
RVBENCH_VECTOR(double, RowMajor, false, RowMajor, false, 1);

using RvbenchComplex = std::complex<double>;
RVBENCH_PANEL(RvbenchComplex, RvbenchComplex, false, false);
RVBENCH_PANEL(RvbenchComplex, RvbenchComplex, true, false);
RVBENCH_PANEL(RvbenchComplex, RvbenchComplex, false, true);
RVBENCH_PACK(RvbenchComplex, ColMajor);
RVBENCH_PACK(RvbenchComplex, RowMajor);
RVBENCH_PRODUCT(RvbenchComplex, ColMajor, false, ColMajor, false);
RVBENCH_PRODUCT(RvbenchComplex, ColMajor, false, RowMajor, false);
RVBENCH_PRODUCT(RvbenchComplex, ColMajor, false, RowMajor, true);
RVBENCH_PRODUCT(RvbenchComplex, RowMajor, false, ColMajor, false);
RVBENCH_PRODUCT(RvbenchComplex, RowMajor, true, ColMajor, false);
RVBENCH_VECTOR(RvbenchComplex, ColMajor, false, ColMajor, false, 0);
RVBENCH_VECTOR(RvbenchComplex, ColMajor, false, RowMajor, false, 0);
RVBENCH_VECTOR(RvbenchComplex, ColMajor, false, RowMajor, true, 0);
RVBENCH_VECTOR(RvbenchComplex, RowMajor, false, ColMajor, false, 0);
RVBENCH_VECTOR(RvbenchComplex, RowMajor, false, ColMajor, true, 0);
RVBENCH_VECTOR(RvbenchComplex, RowMajor, true, ColMajor, false, 0);
RVBENCH_VECTOR(RvbenchComplex, RowMajor, false, RowMajor, true, 1);

#undef RVBENCH_PANEL
#undef RVBENCH_PACK
#undef RVBENCH_PRODUCT
#undef RVBENCH_VECTOR
#undef RVBENCH_KERNEL

}  // namespace Eigen::internal
