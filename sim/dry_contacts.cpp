#include "sim/dry_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rvbench::sim {
namespace {

constexpr double saturated = 20;  // creep speeds: tanh is 1 to the last digit
constexpr int most_sweeps = 50;
constexpr int most_iterations = 60;
constexpr double tolerance = 1e-12;

Eigen::VectorXd direction_of(Axis axis, const std::vector<int>& free) {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i] == axis.body_a) direction[static_cast<Eigen::Index>(i)] = 1;
    if (free[i] == axis.body_b) direction[static_cast<Eigen::Index>(i)] = -1;
  }
  return direction;
}

}  // namespace

DryContacts::DryContacts(const std::vector<const DryFriction*>& terms, const std::vector<int>& free)
    : free_bodies_(static_cast<Eigen::Index>(free.size())) {
  for (const DryFriction* dry : terms) {
    const Axis axis = dry->axis();
    auto contact = std::find_if(contacts_.begin(), contacts_.end(), [axis](const Contact& c) {
      return c.axis.body_a == axis.body_a && c.axis.body_b == axis.body_b;
    });
    if (contact == contacts_.end()) {
      Eigen::VectorXd direction = direction_of(axis, free);
      if (direction.isZero()) continue;
      contacts_.push_back({axis, std::move(direction), {}, {}, 0, 0, 0});
      contact = contacts_.end() - 1;
    }
    contact->shares.push_back({dry, {}, {}, {}});
  }
}

void DryContacts::set_step(const Eigen::MatrixXd& gamma) {
  const auto count = static_cast<Eigen::Index>(contacts_.size());
  mobility_.resize(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    Contact& contact = contacts_[static_cast<std::size_t>(j)];
    contact.response = -gamma.leftCols(free_bodies_) * contact.direction;
    for (Eigen::Index i = 0; i < count; ++i) {
      mobility_(i, j) = -contacts_[static_cast<std::size_t>(i)].direction.dot(
          contact.response.segment(free_bodies_, free_bodies_));
    }
  }
}

void DryContacts::start(const PlantState& s) {
  for (Contact& contact : contacts_) {
    contact.force = 0;
    for (Share& share : contact.shares) {
      share.now = share.term->limits(s);
      contact.force += share.term->effort(s);
    }
    contact.foreseen = contact.force;
  }
}

void DryContacts::add_foreseen(Eigen::VectorXd& r) const {
  for (const Contact& contact : contacts_) {
    r.head(free_bodies_) -= contact.foreseen * contact.direction;
  }
}

void DryContacts::read_limits(const PlantState& s) {
  for (Contact& contact : contacts_) {
    contact.foreseen = contact.force;
    for (Share& share : contact.shares) {
      share.before = share.now;
      share.now = share.term->limits(s);
      share.middle = {std::max(1.5 * share.now.forward - 0.5 * share.before.forward, 0.0),
                      std::max(1.5 * share.now.backward - 0.5 * share.before.backward, 0.0)};
    }
  }
}

double DryContacts::force_at(const Contact& contact, double speed, double& slope) {
  double force = 0;
  slope = 0;
  for (const Share& share : contact.shares) {
    const double limit = speed > 0 ? share.middle.forward : share.middle.backward;
    const double sign = creeping_sign(speed, share.term->creep_speed());
    force += limit * sign;
    slope += limit * (1 - sign * sign) / share.term->creep_speed();
  }
  return force;
}

// u + G·S(u) = free_speed: Newton from the side of 0, where S bends so that it never overshoots.
double DryContacts::solve(const Contact& contact, double mobility, double free_speed) {
  const double side = free_speed < 0 ? -1 : 1;
  double limit = 0, creep = 0;
  for (const Share& share : contact.shares) {
    limit += side > 0 ? share.middle.forward : share.middle.backward;
    creep = std::max(creep, share.term->creep_speed());
  }
  const double sliding = std::abs(free_speed) - mobility * limit;
  if (sliding > saturated * creep) return side * limit;
  double speed = side * std::max(sliding, 0.0), slope = 0, force = 0;
  if (speed == 0) speed = side * std::numeric_limits<double>::min();  // which side's limit counts
  for (int i = 0; i < most_iterations; ++i) {
    force = force_at(contact, speed, slope);
    const double step = (free_speed - speed - mobility * force) / (1 + mobility * slope);
    speed += step;
    if (std::abs(step) <= tolerance * (creep + std::abs(speed))) break;
  }
  return force_at(contact, speed, slope);
}

void DryContacts::correct(const PlantState& s, Eigen::VectorXd& x) {
  for (Contact& contact : contacts_) {
    contact.free_speed = contact.shares.front().term->speed(s);
    contact.force = contact.foreseen;
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      Contact& contact = contacts_[i];
      const auto row = static_cast<Eigen::Index>(i);
      double alone = contact.free_speed + mobility_(row, row) * contact.foreseen;
      for (std::size_t j = 0; j < contacts_.size(); ++j) {
        if (j == i) continue;
        alone -= mobility_(row, static_cast<Eigen::Index>(j)) *
                 (contacts_[j].force - contacts_[j].foreseen);
      }
      const double before =
          std::exchange(contact.force, solve(contact, mobility_(row, row), alone));
      change = std::max(change, std::abs(contact.force - before));
    }
    if (contacts_.size() == 1 || change == 0) break;
  }
  for (const Contact& contact : contacts_) {
    x.noalias() += contact.response * (contact.force - contact.foreseen);
  }
}

}  // namespace rvbench::sim
