#define RVBENCH_KERNEL template
#include "hal/types/eigen_kernels.hpp"
