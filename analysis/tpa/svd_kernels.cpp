#include "analysis/tpa/svd_kernels.hpp"

// Bodies are compiled once per kind of processor, into its own function: that is what the
// attributes are for. They call nothing that could be shared with code for another kind.
#define RVBENCH_INTO_KERNEL [[gnu::always_inline]] inline

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

RVBENCH_INTO_KERNEL void factorise(SvdWorkspace& w) {
  for (int k = 0; k < w.columns; ++k) {
    const auto below = [&](int column) { return w.a.data() + column * w.rows + k; };
    make_reflector(below(k), w.rows - k, w.diagonal[std::size_t(k)], w.strengths[std::size_t(k)]);
    for (int j = k + 1; j < w.columns; ++j) {
      reflect(below(k), w.strengths[std::size_t(k)], w.rows - k, below(j));
    }
  }
}

// Rᴴ, and below it a unit matrix.
RVBENCH_INTO_KERNEL void set_up_rotated(SvdWorkspace& w) {
  const int n = w.columns;
  for (int column = 0; column < n; ++column) {
    Complexes* to = w.rotated.data() + column * 2 * n;
    for (int row = 0; row < 2 * n; ++row) to[row] = Complexes{};
    to[column] = w.diagonal[std::size_t(column)];
    for (int row = column + 1; row < n; ++row) {
      to[row] = w.a[std::size_t(row * w.rows + column)];
    }
    for (int row = column; row < n; ++row) im(to[row]) = -im(to[row]);
    re(to[n + column]) = Lanes{} + 1;
  }
}

// Makes columns p and q orthogonal and the longer one p, where they are not orthogonal yet.
RVBENCH_INTO_KERNEL bool rotate(Complexes* p, Complexes* q, int n, Complexes& square_p,
                                Complexes& square_q) {
  Complexes product;
  dot(p, q, n, product);
  const Lanes square = re(product) * re(product) + im(product) * im(product);
  const Mask turns = square > orthogonal * re(square_p) * re(square_q);
  if ((turns[0] | turns[1] | turns[2] | turns[3]) == 0) return false;
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
  const Lanes p_of_p = swaps ? sine : cosine, p_of_q = swaps ? cosine : -sine;
  const Lanes q_of_p = swaps ? cosine : sine, q_of_q = swaps ? -sine : cosine;
  const Lanes a = p_of_q * phase_re, b = p_of_q * phase_im;
  const Lanes c = q_of_q * phase_re, d = q_of_q * phase_im;
  for (int i = 0; i < 2 * n; ++i) {
    const Lanes pr = re(p[i]), pi = im(p[i]), qr = re(q[i]), qi = im(q[i]);
    re(p[i]) = p_of_p * pr + a * qr - b * qi;
    im(p[i]) = p_of_p * pi + a * qi + b * qr;
    re(q[i]) = q_of_p * pr + c * qr - d * qi;
    im(q[i]) = q_of_p * pi + c * qi + d * qr;
  }
  const Lanes moved = turns ? tangent * size : Lanes{};
  const Lanes new_p = re(square_p) - moved, new_q = re(square_q) + moved;
  re(square_p) = swaps ? new_q : new_p;
  re(square_q) = swaps ? new_p : new_q;
  return true;
}

// One-sided Jacobi. Squares are taken anew before each sweep; the last one turns nothing, so that
// they, and what it found orthogonal, hold for what is left.
RVBENCH_INTO_KERNEL bool diagonalise(SvdWorkspace& w) {
  const int n = w.columns;
  const auto column = [&](int k) { return w.rotated.data() + k * 2 * n; };
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (int k = 0; k < n; ++k) square_norm(column(k), n, re(w.squares[std::size_t(k)]));
    bool turned = false;
    for (int p = 0; p < n; ++p) {
      for (int q = p + 1; q < n; ++q) {
        turned |= rotate(column(p), column(q), n, w.squares[std::size_t(p)],
                         w.squares[std::size_t(q)]);
      }
    }
    if (!turned) return true;
  }
  return false;
}

// U = Q·J
RVBENCH_INTO_KERNEL void make_left(SvdWorkspace& w) {
  const int n = w.columns;
  for (int column = 0; column < n; ++column) {
    Complexes* to = w.left.data() + column * w.rows;
    for (int row = 0; row < n; ++row) {
      to[row] = w.rotated[std::size_t(column * 2 * n + n + row)];
    }
    for (int row = n; row < w.rows; ++row) to[row] = Complexes{};
    for (int k = n - 1; k >= 0; --k) {
      reflect(w.a.data() + k * w.rows + k, w.strengths[std::size_t(k)], w.rows - k, to + k);
    }
  }
}

RVBENCH_INTO_KERNEL bool decompose_lanes(SvdWorkspace& w) {
  factorise(w);
  set_up_rotated(w);
  const bool is_done = diagonalise(w);
  make_left(w);
  return is_done;
}

RVBENCH_INTO_KERNEL void invert_line(const double* left, const double* right, const double* weights,
                                     int rows, int columns, int kept, double* scratch,
                                     double* inverse) {
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
    double* to = inverse + 2 * columns * row;
    for (int i = 0; i < 2 * columns; ++i) to[i] = 0;
    for (int k = 0; k < kept; ++k) {
      const double r = left[2 * (k * rows + row)], s = -left[2 * (k * rows + row) + 1];
      const double* v = straight + 2 * columns * k;
      const double* iv = turned + 2 * columns * k;
      for (int i = 0; i < 2 * columns; ++i) to[i] += r * v[i] + s * iv[i];
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

SvdWorkspace::SvdWorkspace(int row_count, int column_count) : rows(row_count), columns(column_count) {
  const auto m = std::size_t(rows), n = std::size_t(columns);
  a.resize(m * n);
  rotated.resize(2 * n * n);
  left.resize(m * n);
  diagonal.resize(n);
  strengths.resize(n);
  squares.resize(n);
}

const SvdKernels& portable_svd_kernels() {
  static constexpr SvdKernels kernels{portable_decompose, portable_invert};
  return kernels;
}

const SvdKernels& svd_kernels() {
#if defined(__x86_64__)
  static constexpr SvdKernels kernels{avx2_decompose, avx2_invert};
  static const bool has_avx2 =
      __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  if (has_avx2) return kernels;
#endif
  return portable_svd_kernels();
}

}  // namespace rvbench::analysis
