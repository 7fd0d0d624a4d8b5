#pragma once

#include <Eigen/Core>

#include "tests/proof/seal/draw.hpp"

namespace seal {

/// Gaussian noise of unit deviation whose power falls as 1/f^slope above rate/500, slope 0 to 2.
Eigen::VectorXd coloured_noise(Eigen::Index count, double slope, Draw& draw);

/// Its power per Hz at a frequency.
double noise_density(double slope, double frequency_Hz, double rate_Hz);

}  // namespace seal
