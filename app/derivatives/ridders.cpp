#include "app/derivatives/ridders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace voussoir {
namespace {

constexpr int most_halvings = 3;
constexpr double good_enough = 1e-12;  // of the derivative: no further level
constexpr double same_slope = 1e-6;    // of the larger one: two sides differ by more at a kink
constexpr double meets = 1e-9;         // of the answer: another piece has the base's value

struct Extrapolated {
  double value = 0, bar = std::numeric_limits<double>::infinity();
};

// Richardson's table over halved steps, a row at a time
class HalvingTable {
 public:
  // order: of the error's powers, 2 of central differences, 1 of one-sided ones
  explicit HalvingTable(int order) : factor_(order == 2 ? 4 : 2) {}

  // `noise`: the bar of the quotient by those of its answers
  void add(double quotient, double noise) {
    std::vector<Extrapolated> row{{quotient, noise}};
    double power = factor_;
    for (std::size_t j = 1; j <= last_.size(); ++j, power *= factor_) {
      const Extrapolated fine = row[j - 1], coarse = last_[j - 1];
      row.push_back({(power * fine.value - coarse.value) / (power - 1), (power * fine.bar + coarse.bar) / (power - 1)});
      const double bar =
          row[j].bar + std::max(std::abs(row[j].value - fine.value), std::abs(row[j].value - coarse.value));
      if (bar < best_.bar) best_ = {row[j].value, bar};
    }
    last_ = std::move(row);
  }

  const Extrapolated& best() const { return best_; }

 private:
  double factor_;
  std::vector<Extrapolated> last_;  // its bars: noise alone
  Extrapolated best_;
};

class Differences {
 public:
  Differences(const AnswerAt& answer, const DifferenceRequest& request) : ask_(answer), request_(request) {}

  Derivative find() {
    double step = request_.step;
    for (int halving = 0; halving <= most_halvings; ++halving, step /= 2) {
      if (step > request_.below || step > request_.above) continue;
      if (on_base(-step) && on_base(step) && central(step)) return done();
    }
    found_.below = side(-1);
    found_.above = side(1);
    join_sides();
    return done();
  }

 private:
  const PieceAnswer& at(double distance) {
    const auto [place, is_new] = answers_.try_emplace(distance);
    if (is_new) {
      place->second = ask_(distance);
      ++found_.answers;
    }
    return place->second;
  }
  double value(double distance) { return *at(distance).value; }
  bool on_base(double distance) {
    const PieceAnswer& answer = at(distance);
    return answer.value && answer.piece == request_.base.piece;
  }
  double base() const { return *request_.base.value; }
  Derivative done() { return std::move(found_); }

  bool central(double first) {
    if (std::abs(value(first) - base()) <= request_.bar && std::abs(value(-first) - base()) <= request_.bar) {
      found_.value = (value(first) - value(-first)) / (2 * first);
      found_.bar = request_.bar / first;
      found_.still = true;
      return true;
    }
    HalvingTable both(2), up(1), down(1);
    double step = first;
    for (int level = 0; level < request_.levels; ++level, step /= 2) {
      if (!on_base(step) || !on_base(-step)) return false;
      both.add((value(step) - value(-step)) / (2 * step), request_.bar / step);
      up.add((value(step) - base()) / step, 2 * request_.bar / step);
      down.add((base() - value(-step)) / step, 2 * request_.bar / step);
      if (both.best().bar <= good_enough * std::abs(both.best().value)) break;
    }
    found_.below = {down.best().value, down.best().bar, "", {}};
    found_.above = {up.best().value, up.best().bar, "", {}};
    if (differ()) {
      found_.kink = true;
      return true;
    }
    // where a higher derivative jumps at the base, as of water at the top of a crack, the sides know better
    const double apart = std::abs(up.best().value - down.best().value) / 2;
    const double bar_of_sides = std::max(up.best().bar, down.best().bar) + apart;
    const bool sides = bar_of_sides < both.best().bar;
    found_.value = sides ? (up.best().value + down.best().value) / 2 : both.best().value;
    found_.bar = sides ? bar_of_sides : both.best().bar;
    found_.below = found_.above = {};
    return true;
  }

  bool differ() const {
    const double below = *found_.below.value, above = *found_.above.value;
    return std::abs(above - below) >
           2 * (found_.below.bar + found_.above.bar) + same_slope * std::max(std::abs(below), std::abs(above));
  }

  // the largest step from which on all answers of a side belong to one piece
  SideDerivative side(int sign) {
    const double room = sign < 0 ? request_.below : request_.above;
    SideDerivative found;
    double first = request_.step;
    for (int halving = 0; halving <= most_halvings; ++halving, first /= 2) {
      if (first > room) continue;
      if (one_piece(sign * first)) {
        quotients(sign * first, found);
        break;
      }
    }
    if (!found.value && room >= std::ldexp(request_.step, -most_halvings)) found.end = end_of(sign);
    return found;
  }

  bool one_piece(double first) {
    const std::string piece = at(std::ldexp(first, -request_.levels + 1)).piece;
    for (int level = 0; level < request_.levels; ++level) {
      const PieceAnswer& answer = at(std::ldexp(first, -level));
      if (!answer.value || answer.piece != piece) return false;
    }
    return true;
  }

  void quotients(double first, SideDerivative& found) {
    HalvingTable slope(1), start(1);
    for (int level = 0; level < request_.levels; ++level) {
      const double step = std::ldexp(first, -level);
      slope.add((value(step) - base()) / step, 2 * request_.bar / std::abs(step));
      start.add(value(step), request_.bar);
    }
    const bool another = at(first).piece != request_.base.piece;
    const double apart = std::abs(start.best().value - base());
    if (another && apart > meets * std::abs(base()) + 2 * start.best().bar) return;
    found.value = slope.best().value;
    found.bar = slope.best().bar;
    if (another) found.words = at(first).words;
  }

  // of the base's piece, by bisection
  PieceEnd end_of(int sign) {
    double inside = 0, outside = 0;
    for (int k = most_halvings + request_.levels - 1; k >= 0 && outside == 0; --k) {
      const double step = sign * std::ldexp(request_.step, -k);
      if (!answers_.contains(step)) continue;
      (on_base(step) ? inside : outside) = step;
    }
    if (outside == 0) outside = sign * request_.step;
    for (int k = 0; k < request_.bisections; ++k) {
      const double middle = (inside + outside) / 2;
      (on_base(middle) ? inside : outside) = middle;
    }
    const PieceAnswer& answer = at(outside);
    return {std::abs(outside), answer.value ? answer.words : answer.reason};
  }

  void join_sides() {
    const SideDerivative &below = found_.below, &above = found_.above;
    if (below.value && above.value) {
      if (differ()) {
        found_.kink = true;
        return;
      }
      const SideDerivative& better = below.bar < above.bar ? below : above;
      found_.value = better.value;
      found_.bar = std::max(better.bar, std::abs(*below.value - *above.value));
    } else if (below.value || above.value) {
      const SideDerivative& only = below.value ? below : above;
      found_.value = only.value;
      found_.bar = only.bar;
      found_.one_side = true;
    }
    found_.still = found_.value && std::abs(*found_.value) <= request_.bar / request_.step;
  }

  const AnswerAt& ask_;
  const DifferenceRequest& request_;
  std::map<double, PieceAnswer> answers_;
  Derivative found_;
};

}  // namespace

Derivative differentiate(const AnswerAt& answer, const DifferenceRequest& request) {
  return Differences(answer, request).find();
}

}  // namespace voussoir
