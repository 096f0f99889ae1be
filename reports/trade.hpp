#pragma once
// Comparison of all studies: the cost of accuracy, case by case, against the scene as it is.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voussoir::reports {

// one case and the study.json that its report wrote (study_report.hpp)
struct CaseStudy {
  std::string name;
  nlohmann::json study;
};

// The Pareto front of every case for gnuplot, cost as a multiple of that of the scene as it is; a case whose scene
// failed as it is has nothing to compare with and is left out.
std::string trade_csv(const std::vector<CaseStudy>& studies);

// Names of the cases in trade_csv, in its order.
std::vector<std::string> compared_cases(const std::vector<CaseStudy>& studies);

// of some; throws std::out_of_range of none
double median(std::vector<double> values);

// The page "Cost of accuracy": tables, and sentences that read them. The figure is trade.svg.
std::string trade_markdown(const std::vector<CaseStudy>& studies);

}  // namespace voussoir::reports
