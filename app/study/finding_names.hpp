// The files of a study's grids, samples and reliability analyses, each kind numbered from 1.
#pragma once

#include <string>
#include <vector>

#include "app/study/sweep.hpp"

namespace voussoir {

std::vector<std::string> finding_names(const StudyPlan& plan);

}  // namespace voussoir
