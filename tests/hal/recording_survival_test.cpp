#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "hal/recording_file.hpp"
#include "tests/hal/recording_fixture.hpp"

// A forked child of a sanitised process may not start threads, and the writer has one.
#if defined(__SANITIZE_THREAD__)
#define RVBENCH_CANNOT_FORK
#endif

namespace rvbench::hal {
namespace {

using test::ScratchFolder;

// Runs /usr/bin/python3 with h5py; false and a warning if there is none.
bool python_says(const std::string& script, const std::filesystem::path& argument) {
  const std::string python = "/usr/bin/python3 -c \"";
  if (std::system((python + "import h5py\" 2>/dev/null").c_str()) != 0) {
    WARN("skipped: /usr/bin/python3 has no h5py");
    return true;
  }
  return std::system((python + script + "\" '" + argument.string() + "'").c_str()) == 0;
}

}  // namespace

TEST_CASE("h5py reads a recording without rvbench", "[hal][recording]") {
  const ScratchFolder scratch;
  {
    const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(2, 3));
    REQUIRE(made);
    REQUIRE(made.value()->append(1, test::acceleration_block(7.5, 0, 5000, 3)));
    REQUIRE(made.value()->append(1, test::torque_block(7.5, 0, 20)));
    REQUIRE(made.value()->note(8, "°C"));
    REQUIRE(made.value()->end_point({1, 7.5, "ok", 604.5, 2.5}));
  }
  CHECK(python_says(R"(
import h5py, sys
f = h5py.File(sys.argv[1], 'r')
p = f['points/001']
assert (p.attrs['speed_rpm'], p.attrs['load_pct'], p.attrs['repeat']) == (605, 50, 1)
g = p['acceleration']
assert g.attrs['rate_Hz'] == 4960 and g.attrs['full_scale'] == 500
assert [c.decode() for c in g.attrs['channels']] == ['accel_1', 'accel_2', 'accel_3']
assert g.attrs['units'][2].decode() == 'm/s²' and g.attrs['directions'][1].decode() == '-Z'
assert list(g.attrs['sensitivity']) == [0.01] * 3
assert g['data'].shape == (5000, 3) and g['data'].dtype == 'float32'
assert all(g['data'][4999] == [4999, 4999.0625, 4999.125])
assert p['torque/data'].dtype == 'float32' and p['angle/data'].dtype == 'float64'
assert p['angle/data'][19, 0] == 1e5 + 19 * 0.0633
row = f['points/index'][0]
assert (row['point'], row['t0_s'], row['status'], row['speed_rpm']) == (1, 7.5, b'ok', 604.5)
assert f['events'][0]['text'].decode() == '°C'
assert f['points/000/acceleration/data'].shape == (0, 3)
)",
                    scratch / "r.h5"));
}

TEST_CASE("a growing recording can be read, as far as it was flushed", "[hal][recording]") {
  const ScratchFolder scratch;
  const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(2, 2));
  REQUIRE(made);
  RecordingWriter& writer = *made.value();
  REQUIRE(writer.append(0, test::acceleration_block(0, 0, 6000, 2)));
  REQUIRE(writer.end_point({0, 0, "ok", 605, 1}));  // flushes
  CHECK(python_says(R"(
import h5py, sys
f = h5py.File(sys.argv[1], 'r', libver='latest', swmr=True)
d = f['points/000/acceleration/data']
assert d.shape == (6000, 2) and d[5999, 1] == 5999.0625
assert len(f['points/index']) == 1
)",
                    scratch / "r.h5"));
  const Status repaired = repair_recording(scratch / "r.h5");
  REQUIRE_FALSE(repaired);
  CHECK_THAT(repaired.error().where, Catch::Contains("in use by another program"));
  CHECK(writer.append(1, test::acceleration_block(2, 0, 10, 2)));
  CHECK(writer.close());
}

#ifndef RVBENCH_CANNOT_FORK

namespace {

constexpr int scans_per_block = 100;

// Writes blocks until it is killed, and tells through the pipe how many the disk has for sure:
// those of ended points.
[[noreturn]] void write_until_killed(const std::filesystem::path& file, int pipe_end) {
  const auto made = RecordingWriter::create(file, test::layout_of(64, 3));
  if (!made) ::_exit(1);
  for (int point = 0; point < 64; ++point) {
    for (int block = 0; block < 5; ++block) {
      const int first = block * scans_per_block;
      if (!made.value()->append(point, test::acceleration_block(0, first, scans_per_block, 3)) ||
          !made.value()->append(point, test::torque_block(0, first, scans_per_block))) {
        ::_exit(2);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    if (!made.value()->end_point({point, 0, "ok", 605, 1})) ::_exit(3);
    if (::write(pipe_end, &point, sizeof(point)) != sizeof(point)) ::_exit(4);
  }
  ::_exit(5);
}

int last_told(int pipe_end) {
  int last = -1;
  for (int point = 0; ::read(pipe_end, &point, sizeof(point)) == sizeof(point);) last = point;
  return last;
}

// Kills a writer after it told of `points` points. Returns the last one that it told of.
int kill_a_writer(const std::filesystem::path& file, int points, int further_us) {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) write_until_killed(file, ends[1]);
  REQUIRE(child > 0);
  ::close(ends[1]);
  int last = -1;
  for (int told = 0; told < points; ++told) {
    REQUIRE(::read(ends[0], &last, sizeof(last)) == sizeof(last));
  }
  std::this_thread::sleep_for(std::chrono::microseconds(further_us));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  last = std::max(last, last_told(ends[0]));
  ::close(ends[0]);
  return last;
}

void check_intact(const std::filesystem::path& file, int last_point) {
  const auto opened = RecordingReader::open(file);
  REQUIRE(opened);
  RecordingReader& reader = *opened.value();
  REQUIRE(static_cast<int>(reader.results().size()) > last_point);
  for (int point = 0; point <= last_point; ++point) {
    const Result<Recording> read = reader.read(point);
    REQUIRE(read);
    REQUIRE(read.value().status == "ok");
    const Eigen::VectorXd& samples = read.value().find("accel_3")->samples;
    REQUIRE(samples.size() == 5 * scans_per_block);
    REQUIRE(samples[499] == test::acceleration_m_s2(499, 2));
    const Eigen::VectorXd& angle = read.value().find(channel_names::input_angle)->samples;
    REQUIRE(angle.size() == 5 * scans_per_block);
    REQUIRE(angle[499] == test::angle_rad(499));
  }
  const Result<Recording> begun = reader.read(last_point + 2);
  REQUIRE(begun);
  CHECK(begun.value().status == "interrupted");
}

}  // namespace

TEST_CASE("kill -9 costs none of the points that ended", "[hal][recording]") {
  const ScratchFolder scratch;
  for (const int further_us : {0, 137, 411, 733, 1259, 1931}) {
    for (const int points : {1, 8}) {
      CAPTURE(further_us, points);
      const auto file = scratch / ("r" + std::to_string(further_us + points) + ".h5");
      const int last = kill_a_writer(file, points, further_us);
      check_intact(file, last);  // as it was left
      REQUIRE(repair_recording(file));
      check_intact(file, last);
      REQUIRE(repair_recording(file));  // of a sound file: nothing to do
    }
  }
  const auto file = scratch / "r1932.h5";
  CHECK(python_says("import h5py, sys; h5py.File(sys.argv[1], 'r')['points/000']", file));
}

TEST_CASE("kill -9 within a point costs no more than the flush interval", "[hal][recording]") {
  const ScratchFolder scratch;
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(1, 2));
    if (!made) ::_exit(1);
    for (int block = 0;; ++block) {  // one scan each millisecond
      if (!made.value()->append(0, test::acceleration_block(0, block, 1, 2))) ::_exit(2);
      if (::write(ends[1], &block, sizeof(block)) != sizeof(block)) ::_exit(3);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  REQUIRE(child > 0);
  ::close(ends[1]);
  int appended = 0;
  while (appended < 400) REQUIRE(::read(ends[0], &appended, sizeof(appended)) == sizeof(appended));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  appended = std::max(appended, last_told(ends[0]));
  ::close(ends[0]);

  REQUIRE(repair_recording(scratch / "r.h5"));
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  const Result<Recording> read = opened.value()->read(0);
  REQUIRE(read);
  const Eigen::VectorXd& samples = read.value().find("accel_2")->samples;
  // At one scan per millisecond or slower, 100 ms are at most 100 scans; one may be under way.
  CHECK(samples.size() >= appended - 101);
  CHECK(samples.size() <= appended + 2);
  for (int i = 0; i < samples.size(); ++i) REQUIRE(samples[i] == test::acceleration_m_s2(i, 1));
}

TEST_CASE("a full disk is reported, and again at each later call", "[hal][recording]") {
  const ScratchFolder scratch;
  const pid_t child = ::fork();
  if (child == 0) {
    // A limit on the file's size stands for a disk of that size: the same calls fail.
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 20, 1 << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(1, 4));
    if (!made) ::_exit(1);
    Status status = Done{};
    for (int block = 0; status && block < 100; ++block) {
      status = made.value()->append(0, test::acceleration_block(0, 0, 4096, 4));
    }
    if (status) ::_exit(2);
    const bool tells = status.error().where.find("r.h5: journal: write") != std::string::npos &&
                       status.error().where.find("File too large") != std::string::npos;
    if (!tells) ::_exit(3);
    if (made.value()->end_point({0, 0, "ok", 605, 1})) ::_exit(4);
    if (made.value()->close()) ::_exit(5);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("a recording that cannot even be begun leaves no file behind", "[hal][recording]") {
  const ScratchFolder scratch;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};  // of the 63 points' groups
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(63, 12));
    if (made) ::_exit(1);
    ::_exit(made.error().where.find("r.h5") == std::string::npos ? 2 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "r.h5"));
}

#endif

}  // namespace rvbench::hal
