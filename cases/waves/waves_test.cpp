// Waves through columns of blocks: what quiet ends and free surfaces return, one soft joint, level ground between free
// fields.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "cases/case_tools.hpp"
#include "reference/waves/waves.hpp"

namespace voussoir::cases::waves_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr int wave_stage = 2;
const reference::BlockChain chain{1, 2500, 1e10};  // as scene.toml states it
constexpr double entering = 1e-3;                  // m/s

// A sine under a smooth envelope that lasts so many periods.
struct Burst {
  double blocks;  // a wavelength
  double periods = 8;

  double omega() const { return chain.angular_frequency(blocks); }
  double duration() const { return periods * 2 * std::numbers::pi / omega(); }
  double envelope(double part) const {
    return part <= 0 || part >= 1 ? 0 : std::pow(std::sin(std::numbers::pi * part), 2);
  }
  // as the scene's table has it: linear between 64 points
  std::vector<std::string> overrides() const {
    std::vector<double> times, factors;
    for (int i = 0; i <= 64; ++i) {
      times.push_back(duration() * i / 64);
      factors.push_back(envelope(i / 64.0));
    }
    const std::string quiet = "stage.wave.boundary.1.quiet.";
    return {fmt::format("{}frequency_hz={:.15g}", quiet, omega() / (2 * std::numbers::pi)),
            fmt::format("{}times_s=[{:.15g}]", quiet, fmt::join(times, ", ")),
            fmt::format("{}factors=[{:.15g}]", quiet, fmt::join(factors, ", "))};
  }
  // the linear table's own, m/s
  double velocity(double time) const {
    const double at = 64 * time / duration();
    if (at <= 0 || at >= 64) return 0;
    const double i = std::floor(at);
    const double factor = envelope(i / 64) + (at - i) * (envelope((i + 1) / 64) - envelope(i / 64));
    return entering * factor * std::sin(omega() * time);
  }
};

// |∫ v exp(-iωt) dt| between two times, by trapezoids of the rows; m. Of a whole burst it is exact whatever dispersion
// does to its shape, as each frequency travels with its own amplitude.
double spectrum_of(const std::vector<double>& time, const std::vector<double>& v, double omega, double from,
                   double to) {
  std::complex<double> sum = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i - 1] < from || time[i] > to) continue;
    const auto at = [&](std::size_t k) { return v[k] * std::polar(1.0, -omega * time[k]); };
    sum += 0.5 * (time[i] - time[i - 1]) * (at(i) + at(i - 1));
  }
  return std::abs(sum);
}

struct Passage {
  SceneRun run;
  Burst burst;
  double begins = 0;
  std::vector<double> time{};

  Passage(SceneRun done, const Burst& sent) : run(std::move(done)), burst(sent) {
    begins = column(run, "time_s", wave_stage - 1).back();
    time = column(run, "time_s", wave_stage);
    for (double& t : time)
      t -= begins;
  }
  std::vector<double> velocity(const std::string& monitor) const {
    return column(run, monitor + "_velocity_y_m_per_s", wave_stage);
  }
  // of the burst when it has travelled so many blocks; half of what lies before and behind is counted with it
  double amplitude(const std::string& monitor, double travelled, double before, double behind) const {
    const double per_block = 1 / chain.group_speed(burst.blocks);
    return spectrum_of(time, velocity(monitor), burst.omega(), (travelled - before) * per_block,
                       (travelled + behind) * per_block + burst.duration());
  }
  double sent() const {
    std::vector<double> v;
    for (const double t : time)
      v.push_back(burst.velocity(t));
    return spectrum_of(time, v, burst.omega(), time.front(), time.back());
  }
};

// a column of so many blocks
std::vector<std::string> column_of(int blocks, const Burst& burst, double duration) {
  std::vector<std::string> overrides{fmt::format("domain.box.max=[1, {}]", blocks),
                                     fmt::format("repeat.layers.count={}", blocks - 1),
                                     fmt::format("monitors.middle.inside=[0.5, {:g}]", blocks / 2 - 0.5),
                                     fmt::format("monitors.surface.inside=[0.5, {:g}]", blocks - 0.5),
                                     fmt::format("stage.wave.duration_s={:.6g}", duration)};
  for (const std::string& text : burst.overrides())
    overrides.push_back(text);
  return overrides;
}

const std::string because_returned =
    "leapfrog moves the wave's length by (ω h)²/24 and the plate's midpoint rule its impedance by (K h/2C)²/3, below "
    "2e-4 "
    "together; what a burst leaves behind itself in the column's windows is below 1e-3 of what returns";

// How much of a wave implicit steps leave over so many wavelengths. A joint's spring has the share χ = y²/(1 + y²) of
// backward Euler, y = h √(k/m)/2, which is a loss factor of χωh/2; and backward Euler of the velocities takes as much
// again as half of that. Explicit steps: all.
double left_over(double wavelengths, const Burst& burst, double implicit_step) {
  const double y = 0.5 * implicit_step * std::sqrt(chain.stiffness / (chain.density * chain.spacing));
  const double chi = y * y / (1 + y * y);
  return std::exp(-0.75 * std::numbers::pi * wavelengths * burst.omega() * implicit_step * chi);
}

// base, middle, surface and what comes back from the base after the surface; implicit steps of so many s, or 0:
// explicit
void check_column(CaseReport& report, int blocks, const Burst& burst, bool draws, double implicit_step = 0) {
  const double span = blocks / chain.group_speed(burst.blocks);
  const double duration = 2.9 * span + burst.duration();
  std::vector<std::string> overrides = column_of(blocks, burst, duration);
  if (implicit_step > 0)
    for (const std::string& text : {std::string("stage.wave.time.integration=implicit"),
                                    fmt::format("stage.wave.time.step_s={:g}", implicit_step)})
      overrides.push_back(text);
  const Passage p(run("scene.toml", overrides), burst);
  const double half = blocks / 2.0, quarter = blocks / 4.0;
  const double sent = p.sent(), base = p.amplitude("base", 0, quarter, quarter),
               middle = p.amplitude("middle", half, quarter, quarter), top = p.amplitude("surface", blocks, half, half),
               back = p.amplitude("middle", 2.5 * blocks, quarter, quarter);
  const double n = burst.blocks;
  const std::string of = fmt::format(", {:g} blocks a wavelength{}", n, implicit_step > 0 ? ", implicit steps" : "");
  const double steps_error = implicit_step > 0 ? 1e-3 : 0;  // of the wavelength, (ω h)²/12
  const auto record = [&](const std::string& quantity, const std::string& source, double expected, double tolerance,
                          const std::string& because, double found) {
    report.record({quantity + of, "1", Kind::exact, "reference/waves: " + source, expected, {0, tolerance}, because},
                  found, cost(p.run));
  };
  record("returned by the quiet base", "tan²(π/2n)",
         reference::returned_through_half_joint(n, 1) * left_over(2 * blocks / n, burst, implicit_step), 0.01,
         because_returned, back / middle);
  record("base over the entering wave", "2/(1 + cos(π/n))", reference::base_under_wave(n), 1e-3,
         "leapfrog, (ω h)²/24, and the envelope's corners in the entering wave", base / sent);
  record("free surface over the wave", "2 cos(π/n)",
         reference::free_surface(n) * left_over(half / n, burst, implicit_step),
         std::max(steps_error, n > 15 ? 1e-5 : 1e-3),
         "leapfrog, (ω h)²/24 of the wave's length, and what a burst of ten blocks a wavelength leaves behind itself",
         top / middle);
  if (!draws) return;
  std::vector<double> mid = p.velocity("middle"), surface = p.velocity("surface");
  for (std::vector<double>* v : {&mid, &surface})
    for (double& x : *v)
      x /= entering;
  write_csv("waves", "column.csv", {"time_s", "middle", "surface"}, {p.time, mid, surface});
}

TEST(Waves, ColumnWithAQuietBase) {
  CaseReport report("waves", {"returned by the quiet base, 10 blocks a wavelength"});
  check_column(report, 240, {10}, true);
}

TEST(WavesLong, ColumnOfAThousandBlocks) {
  CaseReport report("waves", {"returned by the quiet base, 40 blocks a wavelength"});
  for (const double n : {10., 20., 40.})
    check_column(report, 1000, {n}, false);
}

// implicit steps weaken waves, as much as their equations say
TEST(WavesLong, ColumnByImplicitSteps) {
  CaseReport report("waves", {"returned by the quiet base, 10 blocks a wavelength, implicit steps"});
  check_column(report, 240, {10}, false, 5e-5);
}

void check_soft_joint(CaseReport& report, int blocks, const Burst& burst, double tolerance) {
  const double span = blocks / chain.group_speed(burst.blocks);
  std::vector<std::string> overrides = column_of(blocks, burst, 1.2 * span + burst.duration());
  const int half = blocks / 2;
  for (const std::string& text :
       {fmt::format("repeat.layers.count={}", half - 1), fmt::format("repeat.upper layers.count={}", half - 1),
        fmt::format("joints.soft.point=[0, {}]", half), fmt::format("joints.upper.point=[0, {}]", half + 1),
        fmt::format("monitors.below.inside=[0.5, {:g}]", half / 2 + 0.5),
        fmt::format("monitors.above.inside=[0.5, {:g}]", half + half / 2 + 0.5)})
    overrides.push_back(text);
  const Passage p(run("soft_joint.toml", overrides), burst);
  // what the joint returns passes the lower monitor half a column later than the burst, which is a third of it long
  const double quarter = blocks / 4.0, behind = blocks / 8.0;
  const double before = p.amplitude("below", quarter, quarter, behind),
               after = p.amplitude("above", 3 * quarter, quarter, behind);
  report.record({fmt::format("passed by one soft joint, {:g} blocks a wavelength", burst.blocks),
                 "1",
                 Kind::exact,
                 "reference/waves: 1/√(1 + ((k/kj - 1) tan(π/n))²)",
                 reference::passed_by_joint(burst.blocks, 0.1),
                 {tolerance, 0},
                 "leapfrog, and what the quiet ends return, whose square is below it"},
                after / before, cost(p.run));
}

TEST(Waves, OneSoftJoint) {
  CaseReport report("waves", {"passed by one soft joint, 10 blocks a wavelength"});
  check_soft_joint(report, 240, {10}, 1e-3);
}

TEST(WavesLong, OneSoftJointInAThousandBlocks) {
  CaseReport report("waves", {"passed by one soft joint, 40 blocks a wavelength"});
  check_soft_joint(report, 1000, {40, 6}, 1e-3);
}

// largest difference over the largest value
double off(const std::vector<double>& found, const std::vector<double>& expected) {
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    most = std::max(most, std::abs(found[i] - expected[i]));
    largest = std::max(largest, std::abs(expected[i]));
  }
  return most / largest;
}

TEST(Waves, LevelGroundBetweenFreeFieldsMovesAsAColumn) {
  CaseReport report("waves", {"surface between free fields, off from the column"});
  const reference::SquareGrid grid{1, 2500, 1e10, 5e9, 12};
  constexpr double step = 2e-5, speed = 1e-4, frequency = 50;
  const SceneRun done = run("slope.toml");
  const std::vector<double> middle = column(done, "surface_velocity_x_m_per_s", wave_stage),
                            corner = column(done, "corner_velocity_x_m_per_s", wave_stage),
                            lifted = column(done, "corner_velocity_y_m_per_s", wave_stage);
  std::vector<double> time = column(done, "time_s", wave_stage);
  const double begins = column(done, "time_s", wave_stage - 1).back();
  for (double& t : time)
    t -= begins;
  // means of the sine under the table's triangle over each step
  std::vector<double> wave;
  for (long i = 0; i < std::lround(time.back() / step); ++i) {
    constexpr int parts = 100;
    double sum = 0;
    for (int k = 0; k < parts; ++k) {
      const double t = (static_cast<double>(i) + (k + 0.5) / parts) * step;
      sum += (t < 0.01 ? t / 0.01 : std::max(0.0, 2 - t / 0.01)) * std::sin(2 * std::numbers::pi * frequency * t);
    }
    wave.push_back(speed * sum / parts);
  }
  const std::vector<double> expected = reference::surface_of_column(grid, wave, step);
  // rows are at the begin of steps, at most of them: the velocity is that of the step before
  std::vector<double> shifted;
  for (const double t : time) {
    const long k = std::lround(t / step);
    shifted.push_back(k == 0 ? 0 : expected.at(k - 1));
  }
  const std::string because =
      "blocks pressed together by 1e-6 of their width: so much do faces, arms and the blocks' corners change, ten "
      "times";
  const auto record = [&](const std::string& quantity, double found, double tolerance) {
    report.record(
        {quantity, "1", Kind::exact, "reference/waves: column that repeats sideways", 0, {tolerance, 0}, because},
        found, cost(done));
  };
  record("surface between free fields, off from the column", off(middle, shifted), 1e-5);
  record("corner between free fields, off from the column", off(corner, shifted), 1e-5);
  double highest = 0, fastest = 0;
  for (std::size_t i = 0; i < shifted.size(); ++i) {
    highest = std::max(highest, std::abs(lifted[i]));
    fastest = std::max(fastest, std::abs(shifted[i]));
  }
  record("vertical motion of the corner over the column's horizontal one", highest / fastest, 1e-5);
  std::vector<double> over_wave = middle, column_over_wave = shifted;
  for (std::size_t i = 0; i < time.size(); ++i) {
    over_wave[i] /= speed;
    column_over_wave[i] /= speed;
  }
  write_csv("waves", "slope.csv", {"time_s", "surface", "column"}, {time, over_wave, column_over_wave});
}

}  // namespace
}  // namespace voussoir::cases::waves_test
