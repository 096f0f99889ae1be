#include "app/base/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "app/base/message.hpp"

namespace voussoir {
namespace {

constexpr std::chrono::milliseconds time_between_lines{200};

// a forecast from less than this fraction of a stage is a guess
constexpr double fraction_for_a_forecast = 0.02;

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  const long long whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

bool is_terminal() {
  return ::isatty(STDERR_FILENO);
}

StatusLine::StatusLine(bool wanted, bool terminal, std::chrono::milliseconds between_added)
    : wanted_(wanted), terminal_(terminal), between_(terminal ? time_between_lines : between_added) {}

bool StatusLine::is_due() const {
  return wanted_ && Clock::now() - last_shown_ >= between_;
}

void StatusLine::show(const std::string& text) {
  if (!is_due()) return;
  last_shown_ = Clock::now();
  if (!terminal_) return tell("voussoir: {}\n", text);
  shown_ = true;
  rewrite_line(text);
}

void StatusLine::clear() {
  if (!shown_) return;
  shown_ = false;
  rewrite_line("");
}

void ProgressLine::show(const ProgressReport& report) {
  if (report.stage_number != stage_) {
    stage_ = report.stage_number;
    stage_began_ = Clock::now();
  }
  if (line_.is_due()) line_.show(text(report));
}

std::string ProgressLine::text(const ProgressReport& report) const {
  std::string line = fmt::format("stage {}/{} {}", report.stage_number, report.stage_count, report.stage);
  if (!report.detail.empty()) line += ", " + report.detail;
  line += fmt::format(": {} steps, t = {:.4g} s", report.steps, report.time);
  if (report.unbalanced > 0) line += fmt::format(", unbalanced {:.1e}", report.unbalanced);
  if (report.done >= 0) line += fmt::format(", {:.0f} %", 100 * report.done);
  if (report.done >= fraction_for_a_forecast && report.done < 1) {
    const double spent = std::chrono::duration<double>(Clock::now() - stage_began_).count();
    line += ", about " + duration_text(spent * (1 - report.done) / report.done) + " left";
  }
  return line;
}

}  // namespace voussoir
