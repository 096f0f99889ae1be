#include "app/limit/without_dilation_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/angle.hpp"

namespace voussoir {
namespace {

const char* const rule_of_ends = "joints that slip without opening";
constexpr double one_number = 0.01;  // of the ends: the plain name then holds their mean

struct NamedEnds {
  std::string name, unit;
  std::optional<EndOfFactor> least, largest;
  bool settled;
};

// what a factor of safety divides, which is said once, of the first value
std::string take_divides(LimitAnswer& answer) {
  std::string divides;
  for (auto& [name, value] : answer.values)
    if (!value.divides.empty()) divides = std::exchange(value.divides, {});
  return divides;
}

// in front of all other values
void add_ends(const NamedEnds& ends, LimitAnswer& answer) {
  std::vector<std::pair<std::string, Value>> first;
  const auto add = [&](const std::string& name, double value, double error) {
    const std::optional<double> bar = ends.settled ? std::optional(error) : std::nullopt;
    first.emplace_back(name, Value{value, ends.unit, bar, rule_of_ends});
  };
  const std::string divides = take_divides(answer);
  answer.answered = false;
  if (ends.least && ends.largest) {
    const double apart = ends.largest->factor - ends.least->factor,
                 mean = 0.5 * (ends.least->factor + ends.largest->factor),
                 error = std::max(ends.least->error, ends.largest->error);
    if (std::abs(apart) <= std::max(one_number * std::abs(mean), error))
      add(ends.name, mean, 0.5 * std::abs(apart) + error);
    answer.enclosed = ends.settled;
    answer.answered = ends.settled && std::abs(apart) <= ends.least->error + ends.largest->error;
  }
  answer.without_dilation->apart = !answer.answered && ends.settled;
  if (ends.least) add(ends.name + "_least", ends.least->factor, ends.least->error);
  if (ends.largest) add(ends.name + "_largest", ends.largest->factor, ends.largest->error);
  if (!first.empty()) first.front().second.divides = divides;
  answer.values.insert(answer.values.begin(), first.begin(), first.end());
}

const char* const no_proof = "nothing proves that there is no lower mechanism without dilation";
const char* const held_between =
    "without dilation: from the least to the largest blocks are held by forces that the loads do not ask for. Of "
    "columns "
    "held by their sides the end that is less favourable was right, of toppling slopes the other; confirm it with "
    "'voussoir run'";

}  // namespace

void tell_factor_ends(const FactorEnds& found, LimitAnswer& answer) {
  answer.evidence.programs += found.programs;
  answer.answered = false;
  if (found.status == LimitStatus::carries_any) {
    answer.caveats.push_back("without dilation: normal forces alone, without friction, carry any factor");
    return;
  }
  answer.without_dilation = DilationRounds{found.rounds, found.settled, false};
  if (found.status != LimitStatus::found) {
    answer.caveats.push_back("without dilation: no mechanism was found, as forces grow without bound");
    return;
  }
  if (!answer.message.empty()) answer.caveats.push_back("with dilation: " + answer.message);
  answer.message.clear();
  add_ends({"collapse_factor", "1", found.least, found.unbounded ? std::nullopt : std::optional(found.largest),
            found.settled},
           answer);
  answer.caveats.push_back(no_proof);
  if (found.unbounded)
    answer.caveats.push_back(
        "without dilation: no factor is the largest, as normal forces between blocks that the loads do not ask for may "
        "hold any load");
  else if (found.largest.factor - found.least.factor > found.largest.error + found.least.error)
    answer.caveats.push_back(held_between);
  if (found.least.factor < 0)
    answer.caveats.push_back(
        "without dilation: a negative factor means that gravity alone brings blocks down, unless such forces hold "
        "them");
}

void tell_strength_ends(const LimitRequest& request, const StrengthEnds& found, LimitAnswer& answer) {
  answer.evidence.programs += found.programs;
  answer.without_dilation = DilationRounds{found.rounds, found.settled, false};
  const std::string name = request.factor ? "factor_of_safety" : "critical_friction";
  answer.answered = false;
  answer.message.clear();
  if (!found.strongest)
    answer.message =
        request.factor
            ? "not even a thousand times the strength is enough without dilation, unless forces that the loads do not "
              "ask for hold blocks"
            : "no friction up to 89 degrees is enough without dilation, unless forces that the loads do not ask for "
              "hold "
              "blocks";
  answer.caveats.push_back(no_proof);
  if (found.status == LimitStatus::carries_nothing) return;
  if (found.status != LimitStatus::found) {
    answer.caveats.push_back("without dilation: no mechanism was found, as forces grow without bound");
    return;
  }
  const auto in_degrees = [](std::optional<EndOfFactor> end) {
    if (end) end = EndOfFactor{to_degrees(end->factor), to_degrees(end->error)};
    return end;
  };
  if (request.factor)
    add_ends({name, "1", found.strongest, found.weakest, found.settled}, answer);
  else
    add_ends({name, "deg", in_degrees(found.weakest), in_degrees(found.strongest), found.settled}, answer);
  if (!answer.answered && found.strongest) answer.caveats.push_back(held_between);
}

void tell_decision(const LimitRequest& request, const Decision& found, LimitAnswer& answer) {
  if (!found.rests || !found.falls) {
    answer.caveats.push_back(
        fmt::format("not decided by {} runs on elastic joints: {}", found.runs,
                    found.because.empty() ? "no factor was found at which they rest" : found.because));
    return;
  }
  const bool angle = !request.load && !request.factor;
  const std::string name = request.load ? "collapse_factor" : request.factor ? "factor_of_safety" : "critical_friction";
  const double unit = angle ? to_degrees(1) : 1, rests = unit * *found.rests, falls = unit * *found.falls;
  const std::string divides = take_divides(answer);
  std::erase_if(answer.values, [&](const auto& value) { return value.first == name; });
  answer.values.emplace(answer.values.begin(), name,
                        Value{0.5 * (rests + falls), angle ? "deg" : "1", 0.5 * std::abs(falls - rests),
                              fmt::format("{} runs on elastic joints: the blocks rest at {:.6g} and fall at {:.6g}",
                                          found.runs, rests, falls)});
  answer.values.front().second.divides = divides;
  answer.answered = answer.decided = true;
  answer.caveats.push_back(
      fmt::format("decided by {} run{} with the scene's joint stiffness: the error bar is half of their bracket, and "
                  "leaves out what the stiffness changes",
                  found.runs, found.runs == 1 ? "" : "s"));
}

}  // namespace voussoir
