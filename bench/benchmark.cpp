// How fast the main jobs are, each beside its limit in CPU seconds. One subject per file in
// bench/benchmarks/; build the preset `release` before believing a figure.
#include <benchmark/benchmark.h>

BENCHMARK_MAIN();
