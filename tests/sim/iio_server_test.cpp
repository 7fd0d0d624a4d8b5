#include "sim/iio_server.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <fstream>
#include <limits>
#include <thread>

#include "sim/iio_session.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace rvbench;
using sim::IioFrontEnd;
using sim::IioServer;
using sim::IioSession;
using sim::ScanRing;

namespace {

IioFrontEnd front_end(std::size_t inputs = 3) {
  IioFrontEnd front_end;
  front_end.rate_Hz = 4960;
  front_end.m_s2_per_count = 0.001;
  for (std::size_t i = 0; i < inputs; ++i) front_end.labels.push_back("accel_" + std::to_string(i));
  return front_end;
}

// Each sample says where it belongs: scan 12 of input 1 is 12.001.
hal::AccelerationBlock::Scans scans_from(Eigen::Index first, Eigen::Index count,
                                         Eigen::Index inputs = 3) {
  hal::AccelerationBlock::Scans scans(count, inputs);
  for (Eigen::Index scan = 0; scan < count; ++scan) {
    for (Eigen::Index input = 0; input < inputs; ++input) {
      scans(scan, input) = float(double(first + scan) + 0.001 * double(input));
    }
  }
  return scans;
}

// Pushes scans until it is told to stop.
class Pushing {
 public:
  explicit Pushing(IioServer& server)
      : thread_([&server](const std::stop_token& stop) {
          for (Eigen::Index first = 0; !stop.stop_requested(); first += 10) {
            server.push(scans_from(first, 10));
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
          }
        }) {}

 private:
  std::jthread thread_;
};

// A command of libiio's own tools.
test::Answer shell(const std::string& command) {
  const test::ScratchFolder scratch;
  return test::Program(scratch.path(), {"/bin/sh", "-c", command}).wait();
}

std::string uri(const IioServer& server) { return "ip:127.0.0.1:" + std::to_string(server.port()); }

}  // namespace

TEST_CASE("iio_info, which is not ours, finds device, inputs and attributes", "[sim][iio]") {
  const IioServer server(front_end());
  const auto told = shell("iio_info -u " + uri(server));
  INFO(told.out + told.err);
  CHECK(told.code == 0);
  CHECK(told.err.empty());
  CHECK_THAT(told.out, Catch::Contains("rvbench-daq"));
  CHECK_THAT(told.out, Catch::Contains("3 channels found"));
  CHECK_THAT(told.out, Catch::Contains("accel2:  (input, index: 2, format: le:S32/32>>0)"));
  CHECK_THAT(told.out, Catch::Contains("value: accel_1"));
  CHECK_THAT(told.out, Catch::Contains("sampling_frequency value: 4960.000000000"));
}

TEST_CASE("iio_readdev, which is not ours, reads scan after scan without a hole", "[sim][iio]") {
  IioServer server(front_end());
  const Pushing pushing(server);
  const test::ScratchFolder scratch;
  const std::string file = (scratch / "scans").string();
  const auto read = shell("iio_readdev -u " + uri(server) +
                          " -b 100 -s 1000 rvbench-daq accel0 accel2 >" + file);
  INFO(read.out + read.err);
  CHECK(read.code == 0);
  std::ifstream in(file, std::ios::binary);
  std::vector<std::int32_t> counts(2000);
  in.read(reinterpret_cast<char*>(counts.data()), 8000);
  REQUIRE(in.gcount() == 8000);
  const std::int32_t first = counts[0];
  CHECK(first % 1000 == 0);
  for (std::int32_t scan = 0; scan < 1000; ++scan) {
    REQUIRE(counts[std::size_t(2 * scan)] == first + 1000 * scan);
    REQUIRE(counts[std::size_t(2 * scan + 1)] == first + 1000 * scan + 2);
  }
}

TEST_CASE("its only rate stays as it is, whatever is written", "[sim][iio]") {
  const IioServer server(front_end());
  const auto told =
      shell("iio_attr -u " + uri(server) + " -d rvbench-daq sampling_frequency 102400");
  INFO(told.out + told.err);
  CHECK(told.code == 0);
  CHECK_THAT(told.out, Catch::Contains("4960"));
}

TEST_CASE("a session answers each command, and refuses what makes no sense", "[sim][iio]") {
  const IioFrontEnd daq = front_end();
  ScanRing ring(3, 100);
  IioSession session(daq, ring);
  CHECK(session.answer("VERSION")->starts_with("0.24."));
  CHECK(session.answer("TIMEOUT 100") == "0\n");
  CHECK(session.answer("READ iio:device0 INPUT accel1 label") == "7\naccel_1\n");
  CHECK(session.answer("READ iio:device0 INPUT accel3 label") == "-2\n");
  CHECK(session.answer("READ iio:device0 INPUT accel99999999999999999999 label") == "-2\n");
  CHECK(session.answer("READ iio:device1 sampling_frequency") == "-19\n");
  CHECK(session.answer("READBUF iio:device0 12") == "-9\n");
  CHECK(session.answer("OPEN iio:device0 1 00000008") == "-22\n");
  CHECK(session.answer("OPEN iio:device0 1 xyz") == "-22\n");
  CHECK(session.answer("OPEN iio:device0 1 00000000") == "-22\n");
  CHECK(session.answer("HELLO") == "-19\n");
  CHECK(session.answer("HELLO iio:device0") == "-22\n");
  CHECK(session.answer("") == "-19\n");
  CHECK_FALSE(session.answer("EXIT"));
  REQUIRE(session.answer("OPEN iio:device0 1 00000005") == "0\n");
  CHECK(session.answer("READBUF iio:device0 3") == "-22\n");
  CHECK(session.answer("READBUF iio:device0 99999999999") == "-22\n");
  ring.push({1, 2, -2});
  CHECK(session.answer("READBUF iio:device0 8") ==
        std::string("8\n00000005\n\x01\0\0\0\xfe\xff\xff\xff", 19));
  CHECK(session.answer("WRITE iio:device0 sampling_frequency 6") == "");
  CHECK(session.awaited_bytes() == 6);
  CHECK(session.answer_to_bytes() == "6\n");
  CHECK(session.awaited_bytes() == 0);
}

TEST_CASE("who falls behind is told, and gets no scans that are not his", "[sim][iio]") {
  const IioFrontEnd daq = front_end();
  ScanRing ring(3, 100);
  IioSession session(daq, ring);
  REQUIRE(session.answer("OPEN iio:device0 1 00000007") == "0\n");
  ring.push(std::vector<std::int32_t>(3 * 101, 5));
  CHECK(session.answer("READBUF iio:device0 12") == "-75\n");  // EOVERFLOW
}

TEST_CASE("samples beyond what a count can tell are full scale", "[sim][iio]") {
  IioServer server(front_end(1));
  const test::ScratchFolder scratch;
  const std::string file = (scratch / "scans").string();
  std::jthread pushing([&](const std::stop_token& stop) {
    hal::AccelerationBlock::Scans scans(4, 1);
    scans << 1e9F, -1e9F, std::numeric_limits<float>::quiet_NaN(), 0.0014F;
    while (!stop.stop_requested()) {
      server.push(scans);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  CHECK(shell("iio_readdev -u " + uri(server) + " -b 4 -s 4 rvbench-daq >" + file).code == 0);
  std::ifstream in(file, std::ios::binary);
  std::vector<std::int32_t> counts(4);
  in.read(reinterpret_cast<char*>(counts.data()), 16);
  CHECK(counts == std::vector<std::int32_t>{2147483647, -2147483647, 2147483647, 1});
}
