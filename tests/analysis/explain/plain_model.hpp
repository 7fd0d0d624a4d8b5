#pragma once

#include <vector>

#include "analysis/explain/forward_model.hpp"

namespace rvbench::test {

/// A model whose units, parameters and candidates are lists that the derived class fills.
class PlainModel : public analysis::ForwardModel {
 public:
  const std::vector<analysis::ObservedUnit>& units() const override { return units_; }
  const std::vector<analysis::ModelParameter>& base() const override { return base_; }
  const std::vector<analysis::Candidate>& library() const override { return library_; }

 protected:
  std::vector<analysis::ObservedUnit> units_;
  std::vector<analysis::ModelParameter> base_;
  std::vector<analysis::Candidate> library_;
};

}  // namespace rvbench::test
