#include "bench/tpa_simulation.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/acceptance.hpp"
#include "bench/find_plan.hpp"
#include "bench/json_text.hpp"
#include "bench/rig_factory.hpp"
#include "bench/simulated_recording.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "hal/json_object.hpp"
#include "sequences/silent_observer.hpp"
#include "sim/robot/hammer_test.hpp"
#include "sim/robot/operation.hpp"

namespace rvbench::bench {
namespace {

using nlohmann::ordered_json;

constexpr const char* hammer_channel = "hammer";
constexpr const char* plan_of_reducer = "quick";
constexpr double from_Hz = 5, to_Hz = 500;  // of the project's band

// "straight slow" → "straight_slow"
std::string file_name(std::string name) {
  std::ranges::replace(name, ' ', '_');
  std::erase(name, '+');
  return name;
}

sim::RobotOptions options_of(const SimulatedSession& session) {
  sim::RobotOptions options;
  options.seed = session.seed;
  options.rate_Hz = session.rate_Hz;
  options.record_s = session.record_s;
  options.hit_s = session.hit_s;
  options.hits = session.hits;
  return options;
}

std::string hits_file(const DegreeOfFreedom& path) {
  return "hammer/" + file_name(path.point + " " + path.direction) + ".h5";
}

std::string motion_file(sim::RobotMotion motion, bool is_replaced) {
  return "motions/" + file_name(std::string(sim::card_of(motion).name)) +
         (is_replaced ? "_replaced.h5" : ".h5");
}

std::string reducer_file(bool is_replaced) {
  return is_replaced ? "reducer/J3_replaced.h5" : "reducer/J3.h5";
}

class SessionWriter {
 public:
  SessionWriter(std::filesystem::path folder, const SimulatedSession& session, ProgressBar& bar,
                std::stop_token stop)
      : folder_(std::move(folder)), session_(session), bar_(bar), stop_(std::move(stop)) {}

  Status write() {
    for (const char* part : {"hammer", "motions", "reducer"}) {
      std::filesystem::create_directories(folder_ / part);
    }
    const sim::VirtualRobot robot(options_of(session_));
    if (Status written = write_hits(robot); !written) return written;
    if (Status written = write_motions(robot, false); !written) return written;
    sim::RobotOptions replaced = robot.options();
    replaced.joint3_replaced = true;
    if (Status written = write_motions(sim::VirtualRobot(replaced), true); !written) return written;
    if (session_.with_reducer) {
      for (const bool is_replaced : {false, true}) {
        if (Status written = write_reducer(is_replaced); !written) return written;
      }
    }
    write_file(folder_ / "project.json", json_text(project_of(robot), 1));
    return Done{};
  }

 private:
  void show(double share, const std::string& doing) {
    end_if_stopped(stop_);
    bar_.show("simulate", share, doing);
  }

  Status write_hits(const sim::VirtualRobot& robot) {
    show(0, "hammer test");
    sim::HammerTest test = sim::hammer_test(robot);
    std::size_t next = 0;
    for (const DegreeOfFreedom& path : robot.path_places()) {
      show(0.1 + 0.2 * double(next) / double(test.hits.size()), hits_file(path));
      std::vector<Recording> hits;
      for (; next < test.hits.size(); ++next) {
        const ChannelInfo& force = test.hits[next].channels.front().info;
        if (DegreeOfFreedom{force.name, force.direction} != path) break;
        hits.push_back(std::move(test.hits[next]));
        hits.back().channels.front().info.name = hammer_channel;
      }
      if (Status written = write_vibration_hdf5(folder_ / hits_file(path), hits); !written) {
        return written;
      }
    }
    return Done{};
  }

  Status write_motions(const sim::VirtualRobot& robot, bool is_replaced) {
    for (const sim::RobotMotion motion : sim::robot_motions) {
      show(is_replaced ? 0.5 : 0.3, motion_file(motion, is_replaced));
      const sim::Operation operation = sim::operate(robot, motion);
      const Status written =
          write_vibration_hdf5(folder_ / motion_file(motion, is_replaced), {operation.recording});
      if (!written) return written;
    }
    return Done{};
  }

  // The reducer of joint 3 on the simulated bench.
  Status write_reducer(bool is_replaced) {
    show(is_replaced ? 0.85 : 0.7, reducer_file(is_replaced));
    const auto plan = find_plan(plan_of_reducer);
    auto made =
        make_rig("sim", {.preset = is_replaced ? "healthy" : "input_shaft", .seed = session_.seed});
    const sequences::TestPlan& test = std::get<0>(plan);
    hal::Rig& rig = std::get<0>(made);
    auto writer =
        hal::RecordingWriter::create(folder_ / reducer_file(is_replaced), layout_of(test, rig));
    if (!writer) return writer.error();
    sequences::SilentObserver observer;
    const auto summary = sequences::run_sequence(test, rig, *writer.value(), observer, stop_);
    end_if_stopped(stop_);
    if (summary.ending.outcome != Outcome::pass) {
      return IoError{IoErrc::refused, "simulated bench: " + summary.ending.reason};
    }
    return writer.value()->close();
  }

  static ordered_json places(const std::vector<std::string>& points) {
    return hal::json_object({{"points", points}, {"directions", {"+X", "+Y", "+Z"}}});
  }

  // The points of a stretch of the robot's places, each once.
  static std::vector<std::string> points_of(const std::vector<DegreeOfFreedom>& places,
                                            Eigen::Index first, Eigen::Index last) {
    std::vector<std::string> points;
    for (Eigen::Index i = first; i < last; ++i) {
      const std::string& point = places[std::size_t(i)].point;
      if (points.empty() || points.back() != point) points.push_back(point);
    }
    return points;
  }

  ordered_json hammer_of(const sim::VirtualRobot& robot) const {
    ordered_json hits = ordered_json::array();
    for (const DegreeOfFreedom& path : robot.path_places()) {
      hits.push_back(hal::json_object(
          {{"file", hits_file(path)}, {"point", path.point}, {"direction", path.direction}}));
    }
    return hal::json_object({{"channel", hammer_channel},
                             {"range_N", robot.options().force_range_N},
                             {"acceleration_range_m_s2", robot.options().acceleration_range_m_s2},
                             {"hits", hits}});
  }

  ordered_json project_of(const sim::VirtualRobot& robot) const {
    using Robot = sim::VirtualRobot;
    const auto& sensors = robot.sensor_places();
    ordered_json motions = ordered_json::array();
    for (const sim::RobotMotion motion : sim::robot_motions) {
      ordered_json entry = hal::json_object({{"name", sim::card_of(motion).name},
                                             {"recording", motion_file(motion, false)},
                                             {"after", motion_file(motion, true)}});
      if (session_.with_reducer) {
        entry["reducer"] = hal::json_object({{"joint", "J3"},
                                             {"recording", reducer_file(false)},
                                             {"after", reducer_file(true)},
                                             {"kinematics", "rv20e"}});
      }
      motions.push_back(std::move(entry));
    }
    return hal::json_object(
        {{"tpa", "virtual robot " + std::to_string(session_.seed)},
         {"hammer", hammer_of(robot)},
         {"paths", places(points_of(robot.path_places(), 0, Robot::paths))},
         {"sensors", hal::json_object(
                         {{"indicators", places(points_of(sensors, 0, Robot::indicators))},
                          {"targets", places(points_of(sensors, Robot::first_target,
                                                       Robot::first_validation))},
                          {"validation",
                           places(points_of(sensors, Robot::first_validation, Robot::sensors))}})},
         {"bands", {{{"from_Hz", from_Hz}, {"to_Hz", to_Hz}}}},
         {"motions", motions}});
  }

  std::filesystem::path folder_;
  SimulatedSession session_;
  ProgressBar& bar_;
  std::stop_token stop_;
};

}  // namespace

Status write_virtual_robot(const std::filesystem::path& folder, const SimulatedSession& session,
                           ProgressBar& bar, const std::stop_token& stop) {
  const Status written = SessionWriter(folder, session, bar, stop).write();
  bar.clear();
  return written;
}

}  // namespace rvbench::bench
