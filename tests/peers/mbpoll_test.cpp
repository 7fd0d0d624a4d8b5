#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "sim/inverter_line.hpp"
#include "sim/inverter_server.hpp"
#include "tests/support/program.hpp"

using namespace rvbench;

namespace {

// mbpoll counts registers from 1 and tells them as "[514]: 	2017".
std::string mbpoll(std::vector<std::string> where, std::vector<std::string> what) {
  std::vector<std::string> words{"/usr/bin/mbpoll", "-q", "-1", "-a", "1", "-t", "4"};
  words.insert(words.end(), where.begin(), where.end());
  words.insert(words.end(), what.begin(), what.end());
  const auto answer = test::Program(".", words).wait();
  INFO("needs mbpoll: bench/install_packages --tests");
  INFO(answer.out << answer.err);
  REQUIRE(answer.code == 0);
  return answer.out;
}

// Another master commands the simulated drive and reads it.
void check_table(sim::InverterModel& model, const std::vector<std::string>& line,
                 const std::string& device) {
  auto to = [&](std::vector<std::string> options) {
    options.insert(options.begin(), line.begin(), line.end());
    return options;
  };
  CHECK_THAT(mbpoll(to({"-r", "1", "-c", "2"}), {device}), Catch::Contains("21058"));  // 0x5242
  mbpoll(to({"-r", "257"}), {device, "1", "2017"});
  CHECK(model.state().run == sim::RunCommand::forward);
  CHECK(model.state().setpoint_Hz == Approx(20.17));
  model.set_measured(589.4, 3.21);
  const std::string read = mbpoll(to({"-r", "515", "-c", "2"}), {device});
  CHECK_THAT(read, Catch::Contains("[515]: \t321"));
  CHECK_THAT(read, Catch::Contains("[516]: \t5894"));
  mbpoll(to({"-r", "257"}), {device, "0"});  // function 6
  CHECK(model.state().run == sim::RunCommand::stop);
}

}  // namespace

TEST_CASE("another master finds the simulated drive's registers where its table says",
          "[peer][modbus]") {
  sim::InverterModel model;
  sim::InverterServer server(model);
  check_table(model, {"-p", std::to_string(server.port())}, "127.0.0.1");
}

TEST_CASE("another master finds them on a serial line too", "[peer][modbus][rtu]") {
  sim::InverterModel model;
  sim::InverterLine line(model);
  check_table(model, {"-m", "rtu", "-b", "9600", "-P", "none"}, line.device());
}
