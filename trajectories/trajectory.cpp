#include "trajectories/trajectory.h"

namespace domefall {
namespace {

template <class Kind>
concept Held = requires(const Kind& kind) {
  kind.held_radius();
};
template <class Kind>
concept PassesPeriastron = requires(const Kind& kind) {
  kind.next_periastron(0);
};
template <class Kind>
concept Periodic = requires(const Kind& kind) {
  kind.radial_period();
};
template <class Kind>
concept PassesLengths = requires(const Kind& kind) {
  kind.time_at_l(0, 0);
};
template <class Kind>
concept MayRest = requires(const Kind& kind) {
  kind.is_at_rest(Spacetime());
};

// Asks a kind that does not stay at its radius, and gives the answer of those that do.
template <class Answer, class Question>
Answer ask(const Trajectory& trajectory, const Answer& of_held, const Question& question) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> Answer {
        if constexpr (Held<Kind>)
          return of_held;
        else
          return question(kind);
      },
      trajectory);
}

}  // namespace

OrbitPoint point_at(const Trajectory& trajectory, const ProperTime& tau) {
  return std::visit([&tau](const auto& kind) { return kind.at(tau); }, trajectory);
}

double birth(const Trajectory& trajectory) {
  return ask(trajectory, -kInfinity, [](const auto& kind) { return kind.birth(); });
}

double lifetime(const Trajectory& trajectory) {
  return ask(trajectory, kInfinity, [](const auto& kind) { return kind.death(); });
}

std::optional<ProperTime> time_at(const Trajectory& trajectory, double r, Leg leg,
                                  const ProperTime& after) {
  return ask(trajectory, std::optional<ProperTime>(),
             [&](const auto& kind) { return kind.time_at(r, leg, after); });
}

std::optional<ProperTime> time_at_l(const Trajectory& trajectory, double l,
                                    const ProperTime& after) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> std::optional<ProperTime> {
        if constexpr (PassesLengths<Kind>)
          return kind.time_at_l(l, after);
        else
          return std::nullopt;
      },
      trajectory);
}

std::pair<double, double> reach(const Trajectory& trajectory) {
  return std::visit(
      []<class Kind>(const Kind& kind) -> std::pair<double, double> {
        if constexpr (Held<Kind>)
          return {kind.held_radius(), kind.held_radius()};
        else
          return kind.reach();
      },
      trajectory);
}

std::optional<ProperTime> next_periastron(const Trajectory& trajectory, const ProperTime& after) {
  return std::visit(
      [&after]<class Kind>(const Kind& kind) -> std::optional<ProperTime> {
        if constexpr (PassesPeriastron<Kind>)
          return kind.next_periastron(after);
        else
          return std::nullopt;
      },
      trajectory);
}

double radial_period(const Trajectory& trajectory) {
  return std::visit(
      []<class Kind>(const Kind& kind) {
        if constexpr (Periodic<Kind>)
          return kind.radial_period();
        else
          return kInfinity;
      },
      trajectory);
}

bool is_at_rest(const Trajectory& trajectory, const Spacetime& spacetime) {
  return std::visit(
      [&spacetime]<class Kind>(const Kind& kind) {
        if constexpr (MayRest<Kind>)
          return kind.is_at_rest(spacetime);
        else
          return false;
      },
      trajectory);
}

}  // namespace domefall
