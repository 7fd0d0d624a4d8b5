#include "analysis/tpa/svd_kernels.hpp"

#include <algorithm>

#include "analysis/kernel.hpp"

namespace rvbench::analysis {
namespace {

using Lanes [[gnu::vector_size(32), gnu::may_alias]] = double;
using Mask [[gnu::vector_size(32)]] = long long;
using Complexes = SvdWorkspace::Complexes;

// Cosine of two columns that counts as none, squared. Rounding of the products is a tenth of it.
constexpr double orthogonal = 1e-14 * 1e-14;
// Six or seven do; what is nearly rank deficient takes a few more.
constexpr int most_sweeps = 40;

RVBENCH_INTO_KERNEL const Lanes& re(const Complexes& z) {
  return *reinterpret_cast<const Lanes*>(z.re);
}
RVBENCH_INTO_KERNEL const Lanes& im(const Complexes& z) {
  return *reinterpret_cast<const Lanes*>(z.im);
}
RVBENCH_INTO_KERNEL Lanes& re(Complexes& z) { return *reinterpret_cast<Lanes*>(z.re); }
RVBENCH_INTO_KERNEL Lanes& im(Complexes& z) { return *reinterpret_cast<Lanes*>(z.im); }

RVBENCH_INTO_KERNEL void take_root(Lanes& x) {
  for (int lane = 0; lane < SvdWorkspace::lanes; ++lane) x[lane] = __builtin_sqrt(x[lane]);
}

// dot = xᴴ·y. Two rows at a time: eight sums that do not wait for each other.
RVBENCH_INTO_KERNEL void dot(const Complexes* x, const Complexes* y, int count, Complexes& sum) {
  Lanes rr{}, ii{}, ri{}, ir{}, rr_odd{}, ii_odd{}, ri_odd{}, ir_odd{};
  int i = 0;
  for (; i + 2 <= count; i += 2) {
    rr += re(x[i]) * re(y[i]);
    ii += im(x[i]) * im(y[i]);
    ri += re(x[i]) * im(y[i]);
    ir += im(x[i]) * re(y[i]);
    rr_odd += re(x[i + 1]) * re(y[i + 1]);
    ii_odd += im(x[i + 1]) * im(y[i + 1]);
    ri_odd += re(x[i + 1]) * im(y[i + 1]);
    ir_odd += im(x[i + 1]) * re(y[i + 1]);
  }
  if (i < count) {
    rr += re(x[i]) * re(y[i]);
    ii += im(x[i]) * im(y[i]);
    ri += re(x[i]) * im(y[i]);
    ir += im(x[i]) * re(y[i]);
  }
  re(sum) = (rr + rr_odd) + (ii + ii_odd);
  im(sum) = (ri + ri_odd) - (ir + ir_odd);
}

RVBENCH_INTO_KERNEL void square_norm(const Complexes* x, int count, Lanes& sum) {
  Lanes rr{}, ii{};
  for (int i = 0; i < count; ++i) {
    rr += re(x[i]) * re(x[i]);
    ii += im(x[i]) * im(x[i]);
  }
  sum = rr + ii;
}

// y -= v·(strength·vᴴ·y)
RVBENCH_INTO_KERNEL void reflect(const Complexes* v, const Complexes& strength, int count,
                                 Complexes* y) {
  Complexes along;
  dot(v, y, count, along);
  const Lanes r = re(along) * re(strength), s = im(along) * re(strength);
  for (int i = 0; i < count; ++i) {
    re(y[i]) -= re(v[i]) * r - im(v[i]) * s;
    im(y[i]) -= re(v[i]) * s + im(v[i]) * r;
  }
}

// Householder's: the reflector that turns column x into a multiple of the first unit vector, in
// its place; `diagonal` becomes that multiple. A column of zeros stays.
RVBENCH_INTO_KERNEL void make_reflector(Complexes* x, int count, Complexes& diagonal,
                                        Complexes& strength) {
  Lanes norm;
  square_norm(x, count, norm);
  Lanes size = re(x[0]) * re(x[0]) + im(x[0]) * im(x[0]);
  take_root(norm);
  take_root(size);
  const Lanes one = Lanes{} + 1;
  const Mask has_phase = size > 0;
  const Lanes safe = has_phase ? size : one;
  const Lanes phase_re = has_phase ? re(x[0]) / safe : one;
  const Lanes phase_im = has_phase ? im(x[0]) / safe : Lanes{};
  re(diagonal) = -phase_re * norm;
  im(diagonal) = -phase_im * norm;
  re(x[0]) += phase_re * norm;
  im(x[0]) += phase_im * norm;
  const Lanes half = norm * (norm + size);  // half the squared norm of the reflector
  const Mask is_there = half > 0;
  re(strength) = is_there ? one / (is_there ? half : one) : Lanes{};
}

// In each lane for itself, the longest of the columns from k on becomes column k.
RVBENCH_INTO_KERNEL void pivot(SvdWorkspace& w, int k) {
  for (int lane = 0; lane < SvdWorkspace::lanes; ++lane) {
    int longest = k;
    for (int j = k + 1; j < w.columns; ++j) {
      const bool is_longer =
          w.squares[std::size_t(j)].re[lane] > w.squares[std::size_t(longest)].re[lane];
      if (is_longer) longest = j;
    }
    w.order[std::size_t(k)][std::size_t(lane)] = longest;
    if (longest == k) continue;
    w.squares[std::size_t(longest)].re[lane] = w.squares[std::size_t(k)].re[lane];
    Complexes* x = w.a.data() + k * w.rows;
    Complexes* y = w.a.data() + longest * w.rows;
    for (int row = 0; row < w.rows; ++row) {
      const double real = x[row].re[lane], imag = x[row].im[lane];
      x[row].re[lane] = y[row].re[lane];
      x[row].im[lane] = y[row].im[lane];
      y[row].re[lane] = real;
      y[row].im[lane] = imag;
    }
  }
}

// Squares of what is left of the columns are carried on by differences: good enough to choose by.
RVBENCH_INTO_KERNEL void factorise(SvdWorkspace& w) {
  for (int j = 0; j < w.columns; ++j) {
    square_norm(w.a.data() + j * w.rows, w.rows, re(w.squares[std::size_t(j)]));
  }
  for (int k = 0; k < w.columns; ++k) {
    pivot(w, k);
    const auto below = [&](int column) { return w.a.data() + column * w.rows + k; };
    make_reflector(below(k), w.rows - k, w.diagonal[std::size_t(k)], w.strengths[std::size_t(k)]);
    for (int j = k + 1; j < w.columns; ++j) {
      reflect(below(k), w.strengths[std::size_t(k)], w.rows - k, below(j));
      const Complexes& done = *below(j);
      re(w.squares[std::size_t(j)]) -= re(done) * re(done) + im(done) * im(done);
    }
  }
}

// L = Rᴴ, and a unit matrix for J.
RVBENCH_INTO_KERNEL void set_up_triangle(SvdWorkspace& w) {
  const int n = w.columns;
  for (int column = 0; column < n; ++column) {
    Complexes* to = w.rotated.data() + column * n;
    Complexes* unit = w.rotations.data() + column * n;
    for (int row = 0; row < n; ++row) {
      to[row] = Complexes{};
      unit[row] = Complexes{};
    }
    re(unit[column]) = Lanes{} + 1;
    to[column] = w.diagonal[std::size_t(column)];
    for (int row = column + 1; row < n; ++row) {
      to[row] = w.a[std::size_t(row * w.rows + column)];
    }
    for (int row = column; row < n; ++row) im(to[row]) = -im(to[row]);
  }
}

// Chooses the turn that makes columns p and q orthogonal and the longer one p, where they are not
// orthogonal yet, from their product pᴴ·q; elsewhere the one that leaves them.
RVBENCH_INTO_KERNEL void choose(const Complexes& product, Complexes& square_p, Complexes& square_q,
                                SvdWorkspace::Turn& turn) {
  const Lanes square = re(product) * re(product) + im(product) * im(product);
  const Mask turns = square > orthogonal * re(square_p) * re(square_q);
  turn.is_none = (turns[0] | turns[1] | turns[2] | turns[3]) == 0;
  if (turn.is_none) return;
  const Lanes one = Lanes{} + 1;
  Lanes size = turns ? square : one;
  take_root(size);
  const Lanes inverse = one / size;
  const Lanes zeta = 0.5 * (re(square_q) - re(square_p)) * inverse;
  Lanes root = 1 + zeta * zeta;
  take_root(root);
  const Mask is_rising = zeta > 0;
  const Lanes tangent = (is_rising ? one : -one) / ((is_rising ? zeta : -zeta) + root);
  Lanes secant = 1 + tangent * tangent;
  take_root(secant);
  const Lanes cosine = turns ? one / secant : one;
  const Lanes sine = turns ? cosine * tangent : Lanes{};
  const Lanes phase_re = turns ? re(product) * inverse : one;
  const Lanes phase_im = turns ? -im(product) * inverse : Lanes{};
  // Where q would become the longer one, the two change places.
  const Mask swaps = turns & is_rising;
  const Lanes p_of_q = swaps ? cosine : -sine, q_of_q = swaps ? -sine : cosine;
  re(turn.of_p) = swaps ? sine : cosine;
  im(turn.of_p) = swaps ? cosine : sine;
  re(turn.q_to_p) = p_of_q * phase_re;
  im(turn.q_to_p) = p_of_q * phase_im;
  re(turn.q_to_q) = q_of_q * phase_re;
  im(turn.q_to_q) = q_of_q * phase_im;
  const Lanes moved = turns ? tangent * size : Lanes{};
  const Lanes new_p = re(square_p) - moved, new_q = re(square_q) + moved;
  re(square_p) = swaps ? new_q : new_p;
  re(square_q) = swaps ? new_p : new_q;
}

RVBENCH_INTO_KERNEL void apply(const SvdWorkspace::Turn& turn, int n, Complexes* columns) {
  if (turn.is_none) return;
  Complexes* p = columns + turn.p * n;
  Complexes* q = columns + turn.q * n;
  const Lanes p_of_p = re(turn.of_p), q_of_p = im(turn.of_p);
  const Lanes a = re(turn.q_to_p), b = im(turn.q_to_p);
  const Lanes c = re(turn.q_to_q), d = im(turn.q_to_q);
  for (int i = 0; i < n; ++i) {
    const Lanes pr = re(p[i]), pi = im(p[i]), qr = re(q[i]), qi = im(q[i]);
    re(p[i]) = p_of_p * pr + a * qr - b * qi;
    im(p[i]) = p_of_p * pi + a * qi + b * qr;
    re(q[i]) = q_of_p * pr + c * qr - d * qi;
    im(q[i]) = q_of_p * pi + c * qi + d * qr;
  }
}

// One-sided Jacobi. A sweep is rounds of pairs that share no column: the roots of one pair need not
// wait for the other's. J follows when a sweep is over, so that each of the two stays in the cache.
// Squares are taken anew before each sweep; the last one turns nothing, so that they, and what it
// found orthogonal, hold for what is left.
RVBENCH_INTO_KERNEL bool diagonalise(SvdWorkspace& w) {
  const int n = w.columns;
  Complexes* columns = w.rotated.data();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (int k = 0; k < n; ++k) square_norm(columns + k * n, n, re(w.squares[std::size_t(k)]));
    bool is_done = true;
    for (std::size_t first = 0; first < w.turns.size(); first += std::size_t(w.pairs_per_round)) {
      SvdWorkspace::Turn* round = w.turns.data() + first;
      for (int i = 0; i < w.pairs_per_round; ++i) {
        dot(columns + round[i].p * n, columns + round[i].q * n, n, w.products[std::size_t(i)]);
      }
      for (int i = 0; i < w.pairs_per_round; ++i) {
        choose(w.products[std::size_t(i)], w.squares[std::size_t(round[i].p)],
               w.squares[std::size_t(round[i].q)], round[i]);
      }
      for (int i = 0; i < w.pairs_per_round; ++i) {
        apply(round[i], n, columns);
        is_done &= round[i].is_none;
      }
    }
    if (is_done) return true;
    for (const SvdWorkspace::Turn& turn : w.turns) apply(turn, n, w.rotations.data());
  }
  return false;
}

// U = Q·J
RVBENCH_INTO_KERNEL void make_left(SvdWorkspace& w) {
  const int n = w.columns;
  for (int column = 0; column < n; ++column) {
    Complexes* to = w.left.data() + column * w.rows;
    for (int row = 0; row < n; ++row) {
      to[row] = w.rotations[std::size_t(column * n + row)];
    }
    for (int row = n; row < w.rows; ++row) to[row] = Complexes{};
    for (int k = n - 1; k >= 0; --k) {
      reflect(w.a.data() + k * w.rows + k, w.strengths[std::size_t(k)], w.rows - k, to + k);
    }
  }
}

RVBENCH_INTO_KERNEL bool decompose_lanes(SvdWorkspace& w) {
  factorise(w);
  set_up_triangle(w);
  const bool is_done = diagonalise(w);
  make_left(w);
  return is_done;
}

RVBENCH_INTO_KERNEL void invert_line(const double* __restrict left, const double* __restrict right,
                                     const double* __restrict weights, int rows, int columns,
                                     int kept, double* __restrict scratch,
                                     double* __restrict inverse) {
  // Twice V: times its weight, and that times i. Then a complex product is two real ones.
  double* straight = scratch;
  double* turned = scratch + 2 * columns * kept;
  for (int k = 0; k < kept; ++k) {
    for (int i = 2 * columns * k; i < 2 * columns * (k + 1); i += 2) {
      straight[i] = weights[k] * right[i];
      straight[i + 1] = weights[k] * right[i + 1];
      turned[i] = -straight[i + 1];
      turned[i + 1] = straight[i];
    }
  }
  for (int row = 0; row < rows; ++row) {
    double* __restrict to = inverse + 2 * columns * row;
    for (int i = 0; i < 2 * columns; ++i) to[i] = 0;
    int k = 0;
    for (; k + 2 <= kept; k += 2) {
      const double* u = left + 2 * (k * rows + row);
      const double* next_u = u + 2 * rows;
      const double r = u[0], s = -u[1], next_r = next_u[0], next_s = -next_u[1];
      const double* __restrict v = straight + 2 * columns * k;
      const double* __restrict iv = turned + 2 * columns * k;
      for (int i = 0; i < 2 * columns; ++i) {
        to[i] +=
            (r * v[i] + s * iv[i]) + (next_r * v[i + 2 * columns] + next_s * iv[i + 2 * columns]);
      }
    }
    if (k < kept) {
      const double r = left[2 * (k * rows + row)], s = -left[2 * (k * rows + row) + 1];
      for (int i = 0; i < 2 * columns; ++i) {
        to[i] += r * straight[2 * columns * k + i] + s * turned[2 * columns * k + i];
      }
    }
  }
}

using Complex = std::complex<double>;
const double* parts(const Complex* z) { return reinterpret_cast<const double*>(z); }
double* parts(Complex* z) { return reinterpret_cast<double*>(z); }

bool portable_decompose(SvdWorkspace& w) { return decompose_lanes(w); }

void portable_invert(const Complex* left, const Complex* right, const double* weights, int rows,
                     int columns, int kept, double* scratch, Complex* inverse) {
  invert_line(parts(left), parts(right), weights, rows, columns, kept, scratch, parts(inverse));
}

#if defined(__x86_64__)

#define RVBENCH_AVX2 [[gnu::target("avx2,fma")]]

RVBENCH_AVX2 bool avx2_decompose(SvdWorkspace& w) { return decompose_lanes(w); }

RVBENCH_AVX2 void avx2_invert(const Complex* left, const Complex* right, const double* weights,
                              int rows, int columns, int kept, double* scratch, Complex* inverse) {
  invert_line(parts(left), parts(right), weights, rows, columns, kept, scratch, parts(inverse));
}

#endif

}  // namespace

SvdWorkspace::SvdWorkspace(int row_count, int column_count)
    : rows(row_count), columns(column_count), pairs_per_round(column_count / 2) {
  const auto m = std::size_t(rows), n = std::size_t(columns);
  a.resize(m * n);
  rotated.resize(n * n);
  rotations.resize(n * n);
  left.resize(m * n);
  diagonal.resize(n);
  strengths.resize(n);
  squares.resize(n);
  products.resize(n / 2);
  order.resize(n);
  // Everybody meets everybody: one stays, the others move on around the table; with an odd number
  // whoever meets the one that is not there has a free round.
  const int seats = columns + columns % 2;
  const auto at_seat = [&](int seat, int round) {
    return seat == 0 ? seats - 1 : (seat + round) % (seats - 1);
  };
  for (int round = 0; round < seats - 1; ++round) {
    for (int seat = 0; seat < seats / 2; ++seat) {
      const int i = at_seat(seat, round), j = at_seat(seats - 1 - seat, round);
      if (std::max(i, j) < columns) turns.push_back({.p = std::min(i, j), .q = std::max(i, j)});
    }
  }
}

const SvdKernels& portable_svd_kernels() {
  static constexpr SvdKernels kernels{portable_decompose, portable_invert};
  return kernels;
}

const SvdKernels& svd_kernels() {
#if defined(__x86_64__)
  static constexpr SvdKernels kernels{avx2_decompose, avx2_invert};
  if (has_avx2_and_fma()) return kernels;
#endif
  return portable_svd_kernels();
}

}  // namespace rvbench::analysis
