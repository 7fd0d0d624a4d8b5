#include "analysis/tpa/mimo_convolver.hpp"

#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <string>
#include <type_traits>
#include <vector>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

struct Free {
  void operator()(void* memory) const { fftw_free(memory); }
};
struct Destroy {
  void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy>;

// Doubles aligned for any vector unit, zero at first.
class Aligned {
 public:
  explicit Aligned(Index count) : memory_(fftw_alloc_real(std::size_t(count))) {
    std::fill_n(memory_.get(), count, 0.);
  }
  double* get() const { return memory_.get(); }

 private:
  std::unique_ptr<double[], Free> memory_;
};

// Real transforms of one length between two buffers of its own.
class Transform {
 public:
  explicit Transform(Index length)
      : lines_(length / 2 + 1), time(length), spectrum(2 * ((lines_ + 3) / 4 * 4)) {
    static const bool planner_is_safe = (fftw_make_planner_thread_safe(), true);
    static_cast<void>(planner_is_safe);
    auto* const lines = reinterpret_cast<fftw_complex*>(spectrum.get());
    // Estimated, not measured: measuring would choose by chance, and round by chance.
    there_.reset(fftw_plan_dft_r2c_1d(int(length), time.get(), lines, FFTW_ESTIMATE));
    back_.reset(fftw_plan_dft_c2r_1d(int(length), lines, time.get(), FFTW_ESTIMATE));
  }

  void there() { fftw_execute(there_.get()); }
  void back() { fftw_execute(back_.get()); }
  Index tiles() const { return (lines_ + lines_per_tile - 1) / lines_per_tile; }

  // Between `spectrum` and its tiles, which are `stride` doubles apart.
  void to_tiles(double* tile, Index stride) const {
    const double* from = spectrum.get();
    for (Index t = 0; t < tiles(); ++t, tile += stride, from += doubles_per_tile) {
      for (Index i = 0; i < lines_per_tile; ++i) {
        tile[i] = from[2 * i];
        tile[lines_per_tile + i] = from[2 * i + 1];
      }
    }
  }
  void from_tiles(const double* tile, Index stride) {
    double* to = spectrum.get();
    for (Index t = 0; t < tiles(); ++t, tile += stride, to += doubles_per_tile) {
      for (Index i = 0; i < lines_per_tile; ++i) {
        to[2 * i] = tile[i];
        to[2 * i + 1] = tile[lines_per_tile + i];
      }
    }
  }

 private:
  Index lines_;

 public:
  Aligned time;
  Aligned spectrum;

 private:
  Plan there_;
  Plan back_;
};

struct Sizes {
  Index taps, partition, blocks, parts, length;

  Sizes(const FirMatrix& filters, const ConvolverSettings& settings)
      : taps(filters.taps.rows()),
        partition(settings.partition_samples),
        blocks(settings.partitions_per_pass) {
    constexpr Require require{"MimoConvolver"};
    require(filters.inputs >= 1 && filters.outputs >= 1 && taps >= 1, "no filters");
    require(filters.taps.cols() == filters.inputs * filters.outputs,
            std::to_string(filters.taps.cols()) + " filters");
    require(filters.taps.allFinite(), "a tap is not finite");
    require(partition >= 1 && blocks >= 1, "partition or number of partitions below 1");
    parts = (taps + partition - 1) / partition;
    length = next_fast_length(partition + std::min(partition, taps) - 1);
  }
};

}  // namespace

class MimoConvolver::Engine {
 public:
  Engine(const FirMatrix& filters, const ConvolverSettings& settings, const MacKernels& kernels)
      : sizes_(filters, settings),
        kernels_(kernels),
        transform_(sizes_.length),
        products_{.inputs = filters.inputs,
                  .outputs = filters.outputs,
                  .parts = sizes_.parts,
                  .blocks = sizes_.blocks,
                  .slots = sizes_.parts + sizes_.blocks - 1},
        filters_(transform_.tiles() * filter_stride()),
        spectra_(transform_.tiles() * spectra_stride()),
        sums_(transform_.tiles() * sums_stride()),
        input_(Eigen::MatrixXd::Zero(history() + pass(), filters.inputs)) {
    set_filters(filters);
  }

  Index pass() const { return sizes_.partition * sizes_.blocks; }
  Index ready_after(Index samples) const { return (filled_ + samples) / pass() * pass(); }

  Index push(const Eigen::Ref<const Eigen::MatrixXd>& in, Eigen::Ref<Eigen::MatrixXd> out) {
    constexpr Require require{"MimoConvolver"};
    require(in.cols() == products_.inputs,
            std::to_string(in.cols()) + " inputs come for " + std::to_string(products_.inputs));
    require(out.cols() == products_.outputs && out.rows() >= ready_after(in.rows()),
            "no room for the outputs");
    Index ready = 0;
    for (Index taken = 0; taken < in.rows();) {
      const Index count = std::min(in.rows() - taken, pass() - filled_);
      input_.middleRows(history() + filled_, count) = in.middleRows(taken, count);
      taken += count;
      filled_ += count;
      if (filled_ < pass()) break;
      convolve(out.middleRows(ready, pass()));
      ready += pass();
      filled_ = 0;
    }
    return ready;
  }

 private:
  // Doubles from one tile to the next.
  Index filter_stride() const {
    return products_.parts * products_.outputs * products_.inputs * doubles_per_tile;
  }
  Index spectra_stride() const { return products_.slots * products_.inputs * doubles_per_tile; }
  Index sums_stride() const { return products_.blocks * products_.outputs * doubles_per_tile; }
  // Samples before a block that its transform takes in.
  Index history() const { return sizes_.length - sizes_.partition; }

  void set_filters(const FirMatrix& filters) {
    double* to = filters_.get();
    for (Index part = 0; part < sizes_.parts; ++part) {
      const Index from = part * sizes_.partition;
      const Index count = std::min(sizes_.partition, sizes_.taps - from);
      for (Index filter = 0; filter < filters.taps.cols(); ++filter, to += doubles_per_tile) {
        std::fill_n(transform_.time.get(), sizes_.length, 0.);
        // FFTW's way there and back multiplies by the length.
        for (Index i = 0; i < count; ++i) {
          transform_.time.get()[i] = filters.taps(from + i, filter) / double(sizes_.length);
        }
        transform_.there();
        transform_.to_tiles(to, filter_stride());
      }
    }
  }

  void convolve(Eigen::Ref<Eigen::MatrixXd> out) {
    products_.newest = (products_.newest + sizes_.blocks) % products_.slots;
    for (Index input = 0; input < products_.inputs; ++input) {
      const double* samples = input_.col(input).data();
      for (Index block = 0; block < sizes_.blocks; ++block) {
        std::copy_n(samples + block * sizes_.partition, sizes_.length, transform_.time.get());
        transform_.there();
        const Index slot = (products_.newest + block) % products_.slots;
        transform_.to_tiles(spectra_.get() + (slot * products_.inputs + input) * doubles_per_tile,
                            spectra_stride());
      }
      double* start = input_.col(input).data();
      std::copy_n(start + pass(), history(), start);
    }
    for (Index tile = 0; tile < transform_.tiles(); ++tile) {
      kernels_.accumulate(products_, filters_.get() + tile * filter_stride(),
                          spectra_.get() + tile * spectra_stride(),
                          sums_.get() + tile * sums_stride());
    }
    for (Index output = 0; output < products_.outputs; ++output) {
      for (Index block = 0; block < sizes_.blocks; ++block) {
        transform_.from_tiles(sums_.get() + (block * products_.outputs + output) * doubles_per_tile,
                              sums_stride());
        transform_.back();
        std::copy_n(transform_.time.get() + history(), sizes_.partition,
                    out.col(output).data() + block * sizes_.partition);
      }
    }
  }

  Sizes sizes_;
  const MacKernels& kernels_;
  Transform transform_;
  TileProducts products_;
  Aligned filters_;        // [tile][part][output][input]
  Aligned spectra_;        // [tile][slot][input]
  Aligned sums_;           // [tile][block][output]
  Eigen::MatrixXd input_;  // history and the samples of a pass x inputs
  Index filled_ = 0;       // samples of the pass that have come
};

MimoConvolver::MimoConvolver(const FirMatrix& filters, const ConvolverSettings& settings,
                             const MacKernels& kernels)
    : engine_(std::make_unique<Engine>(filters, settings, kernels)) {}
MimoConvolver::~MimoConvolver() = default;
MimoConvolver::MimoConvolver(MimoConvolver&&) noexcept = default;
MimoConvolver& MimoConvolver::operator=(MimoConvolver&&) noexcept = default;

Index MimoConvolver::latency_samples() const { return engine_->pass(); }
Index MimoConvolver::ready_after(Index samples) const { return engine_->ready_after(samples); }
Index MimoConvolver::push(const Eigen::Ref<const Eigen::MatrixXd>& in,
                          Eigen::Ref<Eigen::MatrixXd> out) {
  return engine_->push(in, out);
}

}  // namespace rvbench::analysis
