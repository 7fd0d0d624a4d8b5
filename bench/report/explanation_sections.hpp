#pragma once

#include <string>

#include "analysis/explain/explanation.hpp"
#include "bench/comparisons.hpp"
#include "bench/located.hpp"

/// Sections of explain.html. Each is HTML; empty if it has nothing to show.
namespace rvbench::bench::report {

/// Errors on what was left out as bars: before, after, what any law would reach, and what repeats
/// differ by.
std::string explained_errors_section(const analysis::Explanation& explanation,
                                     const Comparisons& comparisons);

/// Means and lines that differ by more than chance, before and after. Also says that none does.
std::string located_section(const Located& located);

/// Some records as they are predicted by fits that have not seen their condition: signals over
/// time, the strongest lines side by side.
std::string overlays_section(const Comparisons& comparisons);

/// What is left over of every record before and after, on one scale of colour: by blocks of time,
/// or by the orders that have most of it.
std::string residual_maps_section(const Comparisons& comparisons);

/// Of each two elements the larger, or the one that is known.
Eigen::VectorXd larger_of(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// The orders of a record where most is to be seen, at most `most`, rising; those where it is not
/// known (NaN) come last. Elements count from the first order.
std::vector<Eigen::Index> strongest(const Eigen::VectorXd& of, std::size_t most);

}  // namespace rvbench::bench::report
